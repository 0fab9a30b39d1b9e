# SPDX-License-Identifier: BSD-3-Clause
"""Debian packages, by dpkg-shlibdeps and dpkg-deb."""
import datetime
import gzip
import hashlib
import os
import shutil
import textwrap

from . import build, sbom

# With the address of whoever distributes them, as Debian's tools take it.
MAINTAINER = f"The Limber authors <{os.environ.get('DEBEMAIL', '')}>".replace(" <>", "")
COMMAND_LICENCE = """The sources are BSD-3-Clause. limber loads CHOLMOD, whose supernodal part is
GPL-2.0-or-later, so that the GPL applies to whoever distributes this binary package."""
PACKAGES = {
    "limber": {
        "component": "command", "headers": ["core", "reduction"], "page": True,
        "licence": "GPL-2.0-or-later", "why": COMMAND_LICENCE, "section": "science",
        # Loaded by name: dpkg-shlibdeps does not see them.
        "depends": "libcholmod3, libopenblas0-pthread",
        # Not recommended: with what it recommends itself, gnuplot-nox brings 240 MB.
        "suggests": "gnuplot-nox, limber-mesher, limber-verifier, assimp-utils",
        "title": "simulates capture arms that bend",
        "text": """The command limber, its page for browsers, manual pages, completion, and
            examples with reduced bodies. Geometries and meshes of your own need limber-mesher."""},
    "limber-mesher": {
        "component": "mesher", "headers": ["core"], "licence": "GPL-2.0-or-later",
        "why": "limber-mesh links Gmsh, which is GPL-2.0-or-later.", "section": "science",
        "depends": "limber (= VERSION)",
        "title": "meshes for limber, by Gmsh",
        "text": """The process in which limber reads meshes and meshes geometries. Gmsh brings
            some 400 MB of libraries."""},
    "limber-verifier": {
        "component": "verifier", "headers": ["core", "reduction"],
        "licence": "GPL-3.0-or-later", "section": "science",
        "why": COMMAND_LICENCE + "\nIt links Simbody, which is Apache-2.0, so that the version is 3.",
        "depends": "limber (= VERSION), libcholmod3, libopenblas0-pthread",
        "title": "limber verify: comparison of rigid systems with Simbody",
        "text": "Compares runs of limber at level rigid with those of an independent program."},
    "liblimber-dev": {
        "component": "dev", "headers": ["core", "reduction"], "licence": "GPL-2.0-or-later",
        "why": "limber::limber is BSD-3-Clause; limber::reduction and limber::fem load CHOLMOD, "
               "limber::gmsh links Gmsh (GPL).",
        "section": "libdevel",
        "depends": "libeigen3-dev, libfmt-dev, libhdf5-dev, zlib1g-dev, nlohmann-json3-dev, "
                   "libtomlplusplus-dev, libxxhash-dev, liburdfdom-dev, libtinyxml-dev, "
                   "libmatio-dev, pkg-config",
        "suggests": "limber-mesher, libcholmod3, libgmsh-dev, libsimbody-dev",
        "title": "C++ libraries of limber",
        "text": "Static libraries, headers, and a CMake package: find_package(limber)."},
    "python3-limber": {
        "component": "python", "headers": ["core", "reduction", "python"],
        "licence": "GPL-2.0-or-later", "why": COMMAND_LICENCE, "section": "python",
        "depends": "limber (= VERSION), libcholmod3, libopenblas0-pthread, python3 (>= 3.11), "
                   "python3 (<< 3.12), python3-numpy",
        "suggests": "limber-mesher, python3-pandas, python3-matplotlib",
        "title": "Python module of limber",
        "text": "Scenarios, runs, studies and systems of limber in Python, with NumPy's arrays."},
}
# Compiled modules of Python are made when the package is installed.
PYTHON_SCRIPTS = {
    "postinst": "#!/bin/sh\nset -e\n[ \"$1\" != configure ] || py3compile -p python3-limber\n",
    "prerm": "#!/bin/sh\nset -e\npy3clean -p python3-limber\n"}


def find_depends(root, name, work):
    """Of the programs and shared libraries in a tree, by dpkg-shlibdeps."""
    programs = [file for file in sorted(root.rglob("*")) if file.is_file()
                and not file.is_symlink() and is_loadable(file)]
    if not programs:
        return []
    place = work / f"shlibdeps-{name}"
    (place / "debian").mkdir(parents=True, exist_ok=True)
    (place / "debian/control").write_text(
        f"Source: limber\n\nPackage: {name}\nArchitecture: amd64\n")
    found = build.read("dpkg-shlibdeps", "-O", "--ignore-missing-info",
                       *[f"-e{file}" for file in programs], cwd=place)
    return [found.strip().split("=", 1)[1]]


def is_loadable(file):
    with file.open("rb") as bytes_:
        head = bytes_.read(18)
    return head[:4] == b"\x7fELF" and head[16] in (2, 3)


def write_gzip(file, text):
    with file.open("wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=0) as packed:
        packed.write(text)


def write_documents(root, name, package, builds):
    """copyright, changelog, SBOM."""
    doc = root / "usr/share/doc" / name
    if doc.parent.exists():
        shutil.rmtree(doc.parent)
    doc.mkdir(parents=True)
    programs = [file for file in root.rglob("*") if file.is_file() and is_loadable(file)]
    has_page = package.get("page", False)
    headers = sbom.list_headers(builds, package["headers"]) if has_page else package["headers"]
    parts = sbom.list_parts(sbom.list_libraries(*programs).values(), headers)
    sbom.write_sbom(doc / "sbom.cdx.json", name, package["licence"], parts, has_page)
    write_gzip(doc / "changelog.gz", describe_release().encode())
    write_gzip(doc / "CHANGELOG.md.gz", (build.SOURCE / "CHANGELOG.md").read_bytes())
    text = ["Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/",
            "Upstream-Name: limber", f"Comment: {indent(package['why'])}", "",
            "Files: *", "Copyright: 2026, The Limber authors", "License: BSD-3-Clause",
            indent((build.SOURCE / "LICENSE").read_text(), True), "",
            "Compiled in, with their own licences:", ""]
    for part, licence in sbom.list_compiled_in(headers, has_page, builds):
        text += [f"== {part}", licence]
    (doc / "copyright").write_text("\n".join(text))
    (doc / "copyright").chmod(0o644)


def describe_release():
    """In Debian's form, which apt shows."""
    day = datetime.datetime.fromisoformat(build.RELEASED)
    return (f"limber ({build.VERSION}) unstable; urgency=medium\n\n"
            "  * What is new in this version: CHANGELOG.md.gz, beside this file.\n\n"
            f" -- {MAINTAINER}  {day:%a, %d %b %Y} 00:00:00 +0000\n")


def indent(text, is_whole=False):
    lines = [line or "." for line in text.splitlines()]
    return ("\n " if not is_whole else "\n").join(
        (" " + line if is_whole else line) for line in lines)


def compress_manuals(root):
    for page in sorted((root / "usr/share/man").rglob("*.1")):
        write_gzip(page.with_name(page.name + ".gz"), page.read_bytes())
        page.unlink()


def set_modes(root):
    """Those that do not depend on the builder."""
    for file in [root, *root.rglob("*")]:
        if not file.is_symlink():
            runs = file.is_dir() or (file.stat().st_mode & 0o100 and ".so" not in file.name)
            file.chmod(0o755 if runs else 0o644)


def write_control(root, name, package, depends):
    size = sum(file.stat().st_size for file in root.rglob("*") if file.is_file())
    fields = {
        "Package": name, "Version": build.VERSION, "Architecture": "amd64",
        "Maintainer": MAINTAINER, "Section": package["section"],
        "Priority": "optional", "Installed-Size": str((size + 1023) // 1024),
        "Depends": ", ".join(depends + [package["depends"].replace("VERSION", build.VERSION)]),
        "Suggests": package.get("suggests"),
        "Description": package["title"] + "\n " + "\n ".join(
            textwrap.wrap(" ".join(package["text"].split()), 76, break_on_hyphens=False))}
    control = root / "DEBIAN"
    control.mkdir(mode=0o755)
    sums = [f"{hashlib.md5(file.read_bytes()).hexdigest()}  {file.relative_to(root)}\n"
            for file in sorted((root / "usr").rglob("*")) if file.is_file()]
    (control / "md5sums").write_text("".join(sums))
    (control / "control").write_text(
        "".join(f"{key}: {value}\n" for key, value in fields.items() if value))
    if package["component"] == "python":
        for script, text in PYTHON_SCRIPTS.items():
            (control / script).write_text(text)
            (control / script).chmod(0o755)


def make(builds, work, dist):
    """@yields each package's file"""
    for name, package in PACKAGES.items():
        root = work / "deb" / name
        build.install(builds.whole, package["component"], root)
        if name == "limber":
            build.ship_bodies(builds.whole, root, work)
        if package["component"] == "python":  # found where limber has them
            for file in ("limber-mesh", "view.html"):
                (root / "usr/lib/python3/dist-packages/limber" / file).unlink()
        write_documents(root, name, package, builds)
        compress_manuals(root)
        set_modes(root)
        write_control(root, name, package, find_depends(root, name, work))
        file = dist / f"{name}_{build.VERSION}_amd64.deb"
        build.run("dpkg-deb", "--root-owner-group", "-Zxz", "--build", root, file,
                  env=dict(os.environ, DPKG_DEB_THREADS_MAX="1"),
                  stdout=build.subprocess.DEVNULL)
        yield file
