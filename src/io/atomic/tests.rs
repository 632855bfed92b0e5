use super::*;

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    write_atomically(path, &Progress::silent(), |file| file.write_all(bytes).map_err(|error| Error::file("", error)))
}

fn count(folder: &tempfile::TempDir) -> usize {
    std::fs::read_dir(folder.path()).unwrap().count()
}

#[test]
fn a_failing_writer_leaves_the_folder_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let fail = |path: &Path| {
        write_atomically(path, &Progress::silent(), |file| {
            file.write_all(&[0; 4096]).unwrap();
            file.flush().unwrap();
            Err(Error::Cancelled)
        })
    };
    assert!(matches!(fail(&path), Err(Error::Cancelled)));
    assert_eq!(count(&folder), 0);
    std::fs::write(&path, "before").unwrap();
    assert!(fail(&path).is_err());
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
    write(&path, b"after").unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "after");
    assert_eq!(count(&folder), 1);
}

#[test]
fn a_no_at_the_last_report_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let no = |_: &str, fraction: f64| fraction < 1.0;
    let pending = |name: &str| {
        Pending::written(&folder.path().join(name), |file| file.write_all(b"x").map_err(|error| Error::file("", error))).unwrap()
    };
    let outcome = commit(vec![pending("a"), pending("b")], &Progress::new(&no));
    assert!(matches!(outcome, Err(Error::Cancelled)));
    assert_eq!(count(&folder), 0);
    commit(vec![pending("a"), pending("b")], &Progress::silent()).unwrap();
    assert_eq!(count(&folder), 2);
}

#[test]
fn of_several_files_all_get_their_names_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("old"), "before").unwrap();
    let pending = ["new", "old", "lost"].map(|name| {
        Pending::written(&at(name), |file| file.write_all(b"after").map_err(|error| Error::file("", error))).unwrap()
    });
    // A folder has taken the place meanwhile.
    std::fs::create_dir_all(at("lost/inner")).unwrap();
    assert!(commit(pending.into(), &Progress::silent()).unwrap_err().to_string().contains("lost"));
    assert_eq!(std::fs::read_to_string(at("old")).unwrap(), "before");
    assert!(!at("new").exists());
    assert_eq!(count(&folder), 2);
}

#[test]
fn what_is_kept_to_be_put_back_is_not_cleaned_by_others() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("sky.exr");
    std::fs::write(&target, "before").unwrap();
    let kept = kept(&target).unwrap();
    leftovers::remove_abandoned(folder.path());
    std::fs::write(folder.path().join("new"), "after").unwrap();
    std::fs::rename(folder.path().join("new"), &target).unwrap();
    take_back(vec![(target.clone(), Some(kept))]);
    assert_eq!(std::fs::read_to_string(&target).unwrap(), "before");
    assert_eq!(count(&folder), 1);
}

#[test]
fn targets_that_cannot_be_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| check_writable(&folder.path().join(name));
    assert!(inside("sky.exr").is_ok());
    assert_eq!(count(&folder), 0);
    assert!(check_writable(folder.path()).unwrap_err().to_string().ends_with("is a directory"));
    assert!(inside("missing/sky.exr").unwrap_err().to_string().contains("there is no folder"));
    assert!(check_writable(Path::new("")).is_err());
    #[cfg(unix)]
    {
        assert!(std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status().unwrap().success());
        assert!(inside("pipe").unwrap_err().to_string().ends_with("is not a regular file"));
    }
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    assert!(inside("file/sky.exr").is_err());
    let mut permissions = file.metadata().unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&file, permissions).unwrap();
    assert!(inside("file").unwrap_err().to_string().ends_with("is read-only"));
    assert!(write(&file, b"new").is_err());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "");
}

#[cfg(unix)]
#[test]
fn new_files_can_be_read_by_others_and_links_stay_links() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (real, link) = (folder.path().join("real"), folder.path().join("link"));
    write(&real, b"").unwrap();
    assert_ne!(std::fs::metadata(&real).unwrap().permissions().mode() & 0o077, 0);
    std::os::unix::fs::symlink(&real, &link).unwrap();
    write(&link, b"new").unwrap();
    assert!(link.is_symlink());
    assert_eq!(std::fs::read_to_string(&real).unwrap(), "new");
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_passes_on_its_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    for mode in [0o600, 0o640, 0o664, 0o755] {
        std::fs::write(&path, "").unwrap();
        std::fs::set_permissions(&path, PermissionsExt::from_mode(mode)).unwrap();
        let pending = Pending::new(&path).unwrap();
        // From its birth on, so that nobody reads what is private while it is written.
        assert_eq!(pending.temporary.as_file().metadata().unwrap().permissions().mode() & 0o777, mode);
        commit(vec![pending], &Progress::silent()).unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, mode);
    }
}
