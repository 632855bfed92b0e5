"""What of the sources in src uses what: no circles, neither between folders nor between files.

`python tests/test_arrows.py` lists the arrows between folders, with their numbers, and the circles. Tests inside of files count for nothing, and neither do re-exports: whoever uses a name uses the
file that defines it.
"""

import re
import sys
from fnmatch import fnmatch
from pathlib import Path

SRC = Path(__file__).resolve().parent.parent / "src"

# Circles between files that stay, as patterns of their names, each with the reason.
ALLOWED = {
    ("io/exr.rs", "io/read.rs"): "a picture is read by its format, which makes the picture",
    ("io/exr/attributes.rs", "io/exr/part.rs"): "the fields of a part, and how each is read into it",
    ("light/path_tracer.rs", "light/path_tracer/*"): "one algorithm in several files: a walk, its weights, and the guide that they share",
    ("post/tone/*",): "the list of operators names each operator, and each is one of them",
    ("probe/image.rs", "probe/received.rs"): "a method of an image and what it does",
    ("projection/*",): "the list of projections names each projection, and each is one of them",
    ("python/*",): "objects of Python that make one another",
    ("time/notice.rs", "time/parse.rs", "time/text.rs"): "what is read, and what is told of it",
}

PATH = re.compile(r"(?<![\w:$])((?:\w+::)+)(\w+|\*|\{)")
USE = re.compile(r"^[ \t]*(pub(?:\([^)]*\))?\s+)?use\s+([^;]+);", re.M)


def source(path):
    """The text of a file without comments, strings and modules of tests."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r'//[^\n]*|/\*.*?\*/|b?r#"(?:.|\n)*?"#|"(?:\\.|[^"\\])*"', lambda m: '""' if m[0][0] != "/" else "", text, flags=re.S)
    while found := re.search(r"#\[cfg\(test\)\]\s*(?:#\[[^\]]*\]\s*)*", text):
        start, at, depth = found.start(), found.end(), 0
        while at < len(text):
            if text[at] == "{":
                depth += 1
            elif text[at] == "}":
                depth -= 1
                if depth == 0:
                    break
            elif text[at] == ";" and depth == 0:
                break
            at += 1
        text = text[:start] + text[at + 1 :]
    return text


def leaves(tree):
    """The paths of the tree of a `use`, and the names they get here."""
    tree = tree.strip()
    if found := re.fullmatch(r"((?:\w+::)*)\{(.*)\}", tree, flags=re.S):
        depth, part = 0, ""
        for character in found[2] + ",":
            depth += (character == "{") - (character == "}")
            if character == "," and depth == 0:
                if part.strip():
                    for path, name in leaves(part):
                        path = found[1].split("::")[:-1] + path
                        yield (path[:-1], path[-2]) if path[-1] == "self" and len(path) > 1 else (path, name)
                part = ""
            else:
                part += character
    else:
        path, _, name = tree.partition(" as ")
        path = path.strip().split("::")
        yield path, name.strip() or path[-1]


class Sources:
    def __init__(self, root):
        self.files, self.texts, self.exports, self.uses = {}, {}, {}, {}
        for path in sorted(root.rglob("*.rs")):
            parts = path.relative_to(root).with_suffix("").parts
            if "tests" in parts or parts == ("main",):
                continue
            module = parts[:-1] if parts[-1] in ("mod", "lib") else parts
            self.files[module] = path.relative_to(root).as_posix()
            self.texts[module] = source(path)
        for module, text in self.texts.items():
            found = [(bool(public), path, name) for public, tree in USE.findall(text) for path, name in leaves(tree)]
            self.exports[module] = {name: path for public, path, name in found if public and name != "*"}
            self.exports[module, "*"] = [path[:-1] for public, path, name in found if public and name == "*"]
            self.uses[module] = [path for public, path, _ in found if not public]

    def walk(self, module, path, seen=()):
        """The module that defines what `path` says in `module`; None if it is another crate's or stands in `module` itself."""
        if (module, tuple(path)) in seen:
            return None
        seen = (*seen, (module, tuple(path)))
        if path[0] == "crate":
            at, path = (), path[1:]
        elif path[0] == "self":
            at, path = module, path[1:]
        elif path[0] == "super":
            at = module
            while path and path[0] == "super":
                at, path = at[:-1], path[1:]
        elif (*module, path[0]) in self.files or path[0] in self.exports[module]:
            at = module
        else:
            return None
        while path and (*at, path[0]) in self.files:
            at, path = (*at, path[0]), path[1:]
        if at not in self.files:
            return None
        if path and path[0] in self.exports[at]:
            target = self.exports[at][path[0]]
            return self.walk(at, target + path[1:], seen) or self.walk(at, target, seen) or at
        return at

    def arrows(self):
        """Pairs of files of which the first uses the second."""
        found = set()
        for module, text in self.texts.items():
            paths = list(self.uses[module])
            for head, last in PATH.findall(USE.sub("", text)):
                if head.split("::")[0] in ("crate", "super", "self"):
                    paths.append(head.split("::")[:-1] + ([last] if last not in "*{" else []))
            for path in paths:
                target = self.walk(module, [part for part in path if part != "*"])
                if target is not None and target != module:
                    found.add((self.files[module], self.files[target]))
        return found


def circles(arrows):
    """Sets of nodes each of which can be reached from each other."""
    nodes = {node for arrow in arrows for node in arrow}
    next_ = {node: {b for a, b in arrows if a == node} for node in nodes}

    def reached(node):
        seen, todo = set(), [node]
        while todo:
            for other in next_[todo.pop()] - seen:
                seen.add(other)
                todo.append(other)
        return seen

    reach = {node: reached(node) for node in nodes}
    return {frozenset(b for b in reach[a] if a in reach[b]) for a in nodes if a in reach[a]}


def folder(file):
    return file.split("/")[0].removesuffix(".rs")


def between_folders(arrows):
    return {(folder(a), folder(b)) for a, b in arrows if folder(a) != folder(b) and folder(a) != "lib"}


def test_no_arrow_between_folders_runs_back():
    assert circles(between_folders(Sources(SRC).arrows())) == set()


def test_files_are_in_no_circle_but_those_that_are_named():
    found = circles(Sources(SRC).arrows())
    named = [circle for circle in found if any(all(any(fnmatch(file, name) for name in names) for file in circle) for names in ALLOWED)]
    assert not found - set(named), [sorted(circle) for circle in found - set(named)]


def test_a_circle_is_found(tmp_path):
    texts = {
        "lib.rs": "mod a;\nmod b;\n",
        "a/mod.rs": "mod deep;\npub use deep::Thing;\n",
        "a/deep.rs": "use crate::b::{other, third as more};\npub struct Thing;\n",
        "b.rs": "// use crate::a::Thing;\npub fn other() {}\n#[cfg(test)]\nmod tests {\n    use crate::a::Thing;\n}\n",
    }
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    assert Sources(tmp_path).arrows() == {("a/deep.rs", "b.rs")}
    (tmp_path / "b.rs").write_text("pub fn other() -> crate::a::Thing {}\n")
    assert circles(Sources(tmp_path).arrows()) == {frozenset({"a/deep.rs", "b.rs"})}


def test_the_sky_is_in_its_own_file_and_its_parts():
    sky = SRC / "sky"
    with_methods = {path.relative_to(sky).as_posix() for path in sky.rglob("*.rs") if re.search(r"^impl Sky \{", source(path), flags=re.M)}
    assert with_methods == {"place_and_time.rs", "spectra.rs", "composition.rs"}


if __name__ == "__main__":
    arrows = Sources(SRC).arrows()
    for a in sorted({folder(a) for a, _ in arrows}):
        to = sorted({folder(b) for x, b in arrows if folder(x) == a} - {a})
        print(f"{a} -> {', '.join(to)}")
    print(len(arrows), "arrows between files,", len(between_folders(arrows)), "between folders")
    for circle in sorted(map(sorted, circles(between_folders(arrows)) | circles(arrows))):
        print("circle:", ", ".join(circle))
        for a, b in sorted(arrows):
            if a in circle and b in circle:
                print("   ", a, "->", b)
    sys.exit(bool(circles(arrows)))
