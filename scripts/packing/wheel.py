# SPDX-License-Identifier: BSD-3-Clause
"""Wheels: limber, free of the GPL and so without meshing and reduction, and limber-reduction,
which adds them to it. They have the shared libraries that they need."""
import re
import shutil

from . import build, deb, sbom, tarball

# glibc of Debian 12; libstdc++ is left to the system, as other modules share it.
TAG = "cp311-cp311-manylinux_2_36_x86_64"
OF_THE_SYSTEM = re.compile(r"lib(stdc\+\+|gcc_s)\.so")
WHEELS = {
    "limber": {
        "licence": "BSD-3-Clause", "headers": ["core", "python"],
        "needs": ["Requires-Dist: numpy", "Provides-Extra: reduction",
                  'Requires-Dist: limber-reduction (==VERSION) ; extra == "reduction"'],
        "summary": "Simulates arms that bend",
        "text": """limber simulates capture arms that bend, with contact.

This wheel is BSD-3-Clause. It runs scenes whose links use reduced bodies (`<reduced
file="link.h5"/>`) and rigid ones. Meshing and reduction use Gmsh and CHOLMOD, which are GPL:

    pip install limber[reduction]

adds limber-reduction (GPL-2.0-or-later), of the same version."""},
    "limber-reduction": {
        "licence": "GPL-2.0-or-later", "headers": ["core", "reduction", "python"],
        "needs": ["Requires-Dist: limber (==VERSION)"],
        "summary": "Meshing and reduction for limber, by Gmsh and CHOLMOD (GPL)",
        "text": """Adds meshing and reduction to the module limber. Contains Gmsh and CHOLMOD,
so that it is GPL-2.0-or-later as a whole."""},
}


def describe(name):
    wheel = WHEELS[name]
    lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {build.VERSION}",
             f"Summary: {wheel['summary']}", f"License: {wheel['licence']}",
             "Requires-Python: ==3.11.*", "License-File: LICENSE",
             "Description-Content-Type: text/markdown",
             *(line.replace("VERSION", build.VERSION) for line in wheel["needs"])]
    return "\n".join(lines) + f"\n\n{wheel['text']}\n"


def stage(name, builds, work):
    """Module and its companions: root with the folder of the package."""
    build_folder = builds.free if name == "limber" else builds.whole
    place = work / "wheel" / f"{name}-stage"
    build.install(build_folder, "python", place)
    root = work / "wheel" / name
    package = root / name.replace("-", "_")
    shutil.copytree(place / "usr/lib/python3/dist-packages/limber", package)
    if name != "limber":
        for file in package.glob("*.py*"):
            file.unlink()
        (package / "__init__.py").write_text(
            f'"""{WHEELS[name]["summary"]}: the module limber uses it."""\n\n'
            f'__version__ = "{build.VERSION}"\n')
    return root, package


def make_one(name, builds, work, dist):
    root, package = stage(name, builds, work)
    programs = [file for file in sorted(package.iterdir()) if deb.is_loadable(file)]
    asked = programs + ([] if name == "limber" else [sbom.CHOLMOD])
    libraries = sbom.list_libraries(*asked)
    if name != "limber":
        libraries[sbom.CHOLMOD.name] = sbom.CHOLMOD.resolve()
    libraries = {library: file for library, file in libraries.items()
                 if not OF_THE_SYSTEM.match(library)}
    tarball.bundle(libraries, package / "lib", dict.fromkeys(programs, "lib"))
    headers = WHEELS[name]["headers"]
    info = root / f"{package.name}-{build.VERSION}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(describe(name))
    (info / "WHEEL").write_text(
        f"Wheel-Version: 1.0\nGenerator: limber\nRoot-Is-Purelib: false\nTag: {TAG}\n")
    (info / "top_level.txt").write_text(package.name + "\n")
    shutil.copyfile(build.SOURCE / "LICENSE", info / "LICENSE")
    tarball.write_licences(info / "licenses", libraries, headers, True, builds)
    sbom.write_sbom(info / "sboms/sbom.cdx.json", name, WHEELS[name]["licence"],
                    sbom.list_parts(libraries.values(), headers), True)
    deb.set_modes(root)
    build.run("/usr/bin/python3", "-m", "wheel", "pack", root, "-d", dist,
              stdout=build.subprocess.DEVNULL)
    return dist / f"{package.name}-{build.VERSION}-{TAG}.whl"


def make(builds, work, dist):
    """@yields each wheel"""
    for name in WHEELS:
        yield make_one(name, builds, work, dist)
