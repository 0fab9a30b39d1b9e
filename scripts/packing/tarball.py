# SPDX-License-Identifier: BSD-3-Clause
"""A folder that runs from anywhere: the command with all its libraries."""
import gzip
import shutil
import tarfile

from . import build, deb, sbom

LICENCE = "GPL-3.0-or-later"
READ_ME = """Limber {version}

    bin/limber run share/limber/examples/struck_finger.toml

runs from this folder, wherever it is, without installation, on Linux with glibc 2.36 or later.
Remove the folder to uninstall, and ~/.cache/limber, where limber keeps reduced bodies.

Limber is BSD-3-Clause (LICENSE). This folder also contains Gmsh and CHOLMOD, which are GPL, so
that the GPL applies to whoever distributes it. Licences of all parts: LICENSES; their versions,
which are Debian's and whose sources Debian distributes: sbom.cdx.json.
"""


def bundle(libraries, folder, patched):
    """Copies shared libraries, which then find each other there.

    @param libraries by file name
    @param patched {program: its path to `folder`, from $ORIGIN}
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name, file in libraries.items():
        shutil.copyfile(file, folder / name)
        (folder / name).chmod(0o644)
        build.run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN", folder / name)
    for program, path in patched.items():
        build.run("patchelf", "--force-rpath", "--set-rpath", f"$ORIGIN/{path}", program)


def write_licences(folder, libraries, headers, has_page, builds):
    folder.mkdir()
    for package in sorted(set(sbom.find_packages(list(libraries.values())).values())):
        (folder / f"{package}.txt").write_text(sbom.read_copyright(package))
    for part, text in sbom.list_compiled_in(headers, has_page, builds):
        (folder / f"{part}.txt").write_text(text)
    for name in ("GPL-2", "GPL-3", "LGPL-2.1", "LGPL-3", "Apache-2.0", "MPL-2.0"):
        shutil.copyfile(f"/usr/share/common-licenses/{name}", folder / name)


def pack(folder, file):
    """The same bytes each time: sorted, of nobody, at one time."""
    def tidy(info):
        info.uid = info.gid = 0
        info.uname = info.gname = ""
        info.mtime = build.find_epoch()
        return info
    with file.open("wb") as raw, gzip.GzipFile("", "wb", 6, raw, mtime=0) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.GNU_FORMAT) as archive:
        for each in [folder, *sorted(folder.rglob("*"))]:
            archive.add(each, each.relative_to(folder.parent), recursive=False, filter=tidy)


def stage(builds, work, examples="*"):
    """@returns the folder, which runs from anywhere"""
    root = work / "tarball"
    for component in ("command", "mesher", "verifier"):
        build.install(builds.whole, component, root)
    build.ship_bodies(builds.whole, root, work, examples)
    folder = root / f"limber-{build.VERSION}"
    (root / "usr").rename(folder)
    command = folder / "bin/limber"
    helpers = sorted((folder / "libexec/limber").iterdir())
    libraries = sbom.list_libraries(command, *helpers, sbom.CHOLMOD)
    libraries[sbom.CHOLMOD.name] = sbom.CHOLMOD.resolve()
    bundle(libraries, folder / "lib/limber",
           {command: "../lib/limber", **dict.fromkeys(helpers, "../../lib/limber")})
    headers = sbom.list_headers(builds, ["core", "reduction"])
    shutil.rmtree(folder / "share/doc")
    shutil.copyfile(build.SOURCE / "LICENSE", folder / "LICENSE")
    (folder / "README").write_text(READ_ME.format(version=build.VERSION))
    write_licences(folder / "LICENSES", libraries, headers, True, builds)
    sbom.write_sbom(folder / "sbom.cdx.json", "limber", LICENCE,
                    sbom.list_parts(libraries.values(), headers), True)
    deb.set_modes(folder)
    return folder


def make(builds, work, dist):
    """@yields the archive"""
    folder = stage(builds, work)
    file = dist / f"limber-{build.VERSION}-linux-x86_64.tar.gz"
    pack(folder, file)
    yield file
