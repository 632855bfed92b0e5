#!/usr/bin/env python3
"""Say what the extension module in a wheel for Windows exports and imports, and refuse one that Python's stable ABI and Windows 10 do not have.

    .ci/check_windows_module.py WHEEL

Reads the file itself (a Portable Executable of 64 bits), so that it runs anywhere. Exit code 1 if the module does not export its initialiser, links
a Python of one version, or needs a library that is part neither of Python nor of Windows.
"""

import re
import struct
import sys
import zipfile

SYSTEM = {
    "advapi32.dll", "bcrypt.dll", "bcryptprimitives.dll", "combase.dll", "dbghelp.dll", "kernel32.dll", "msvcrt.dll", "ntdll.dll", "ole32.dll", "shell32.dll",
    "ucrtbase.dll", "user32.dll", "userenv.dll", "ws2_32.dll",
}  # fmt: skip
EXPORTS, IMPORTS = 0, 1


class Module:
    """The tables of a 64-bit Portable Executable."""

    def __init__(self, content):
        self.content = content
        (header,) = struct.unpack_from("<I", content, 0x3C)
        if content[header : header + 4] != b"PE\0\0":
            raise ValueError("not a Portable Executable")
        (sections,) = struct.unpack_from("<H", content, header + 6)
        (optional_size,) = struct.unpack_from("<H", content, header + 20)
        optional = header + 24
        if struct.unpack_from("<H", content, optional) != (0x20B,):
            raise ValueError("not of 64 bits")
        self.directories = [struct.unpack_from("<II", content, optional + 112 + 8 * k) for k in range(16)]
        first = optional + optional_size
        self.sections = [struct.unpack_from("<IIII", content, first + 40 * k + 8) for k in range(sections)]

    def offset(self, address):
        """Return where in the file the memory at `address` comes from."""
        for size, start, stored, offset in self.sections:
            if start <= address < start + max(size, stored):
                return offset + address - start
        raise ValueError(f"no section holds the address {address:#x}")

    def text(self, address):
        start = self.offset(address)
        return self.content[start : self.content.index(0, start)].decode("ascii")

    def exports(self):
        """Return the names that the module offers."""
        address, size = self.directories[EXPORTS]
        if not size:
            return []
        (count,) = struct.unpack_from("<I", self.content, self.offset(address) + 24)
        (names,) = struct.unpack_from("<I", self.content, self.offset(address) + 32)
        return [self.text(name) for name in struct.unpack_from(f"<{count}I", self.content, self.offset(names))]

    def imports(self):
        """Return the names of the libraries that the module loads, each with the names it takes from them."""
        at, found = self.offset(self.directories[IMPORTS][0]), {}
        while True:
            lookup, _, _, name, thunks = struct.unpack_from("<5I", self.content, at)
            if not name:
                return found
            taken, entry = found.setdefault(self.text(name), []), self.offset(lookup or thunks)
            while value := struct.unpack_from("<Q", self.content, entry)[0]:
                taken.append(f"#{value & 0xFFFF}" if value >> 63 else self.text(value + 2))
                entry += 8
            at += 20


def faults(module):
    """Return what is wrong with the module, a sentence each."""
    found = []
    if module.exports() != ["PyInit__core"]:
        found.append(f"it exports {', '.join(module.exports()) or 'nothing'}, where PyInit__core alone is right")
    libraries = {name.lower() for name in module.imports()}
    found += [f"it loads {name}, a Python of one version" for name in sorted(libraries) if re.fullmatch(r"python3\d+t?\.dll", name)]
    if "python3.dll" not in libraries:
        found.append("it does not load python3.dll, the stable ABI")
    foreign = {name for name in libraries if name not in SYSTEM and not re.fullmatch(r"api-ms-win-[a-z0-9-]+\.dll|python3\d*t?\.dll", name)}
    return found + [f"it loads {name}, which is part neither of Python nor of Windows" for name in sorted(foreign)]


def main():
    archive = zipfile.ZipFile(sys.argv[1])
    (name,) = [name for name in archive.namelist() if name.endswith(".pyd")]
    module = Module(archive.read(name))
    print(f"{name} exports {', '.join(module.exports()) or 'nothing'}")
    for library, taken in sorted(module.imports().items()):
        print(f"{name} loads {library}: {len(taken)} names")
    wrong = faults(module)
    for sentence in wrong:
        print(f"{name}: {sentence}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
