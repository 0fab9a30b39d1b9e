#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what scripts/package would make of a build, without root and network: the folder
of the archive runs from anywhere, nothing names the machine that built it, every command has
a manual page, and all places state the same version.

  check_packages.py SOURCE_FOLDER BUILD_FOLDER
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def fail(what):
    sys.exit(f"check_packages: {what}")


def run_plainly(*command, folder):
    """With an empty environment but for a home of its own."""
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True,
                          text=True, env={"HOME": str(folder)})
    if done.returncode != 0:
        fail(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def check_versions(build, limber):
    """CMakeLists.txt says which; these must agree."""
    version, day = build.VERSION, build.RELEASED
    places = {
        "CHANGELOG.md": f"## [{version}] - {day}\n",
        "CITATION.cff": f"version: {version}\ndate-released: {day}\n",
        "README.md": f"version = {{{version}}}",
        "docs/how-to/install.md": f"limber_{version}_amd64.deb"}
    for name, text in places.items():
        if text not in (build.SOURCE / name).read_text():
            fail(f"{name} does not say '{text.strip()}'")
    cited = subprocess.run([limber, "--cite"], check=True, capture_output=True, text=True).stdout
    if "".join(f"    {line}\n" for line in cited.splitlines()) not in (
            build.SOURCE / "README.md").read_text():
        fail("README.md does not cite as limber --cite does")
    if f"limber {version}\n" not in subprocess.run(
            [limber, "--version"], check=True, capture_output=True, text=True).stdout:
        fail(f"limber --version is not {version}")


def check_libraries(folder):
    """All but the C library's are the folder's own."""
    programs = [folder / "bin/limber", *(folder / "libexec/limber").iterdir(),
                *(folder / "lib/limber").iterdir()]
    for program in programs:
        for line in run_plainly("/usr/bin/ldd", program, folder=folder).splitlines():
            place = re.search(r"=> (/.+) \(0x", line)
            is_own = place and place.group(1).startswith(str(folder))
            if place and not is_own and not re.search(
                    r"/(lib(c|m|dl|rt|pthread|resolv|util|anl)|ld-linux[^/]*)\.so", line):
                fail(f"{program.name} takes {place.group(1)}")
            if "not found" in line:
                fail(f"{program.name}: {line.strip()}")


def check_paths(folder, *builders):
    for file in folder.rglob("*"):
        if file.is_file() and not file.is_symlink():
            content = file.read_bytes()
            for path in builders:
                if os.fsencode(path) in content:
                    fail(f"{file.relative_to(folder)} names {path}")


def check_manuals(folder):
    """A page for each command that completion knows."""
    words = run_plainly(folder / "bin/limber", "__complete", "", folder=folder).splitlines()
    commands = [line.split("\t")[0] for line in words]
    if len(commands) < 15:
        fail(f"completion knows only {commands}")
    for command in commands:
        if not (folder / f"share/man/man1/limber-{command}.1").exists():
            fail(f"limber {command} has no manual page")


def check_examples(folder, elsewhere):
    """The first example takes its bodies from the folder; after a change of its mesh it
    makes them anew."""
    helpers = folder / "libexec"
    helpers.rename(folder / "hidden")  # no mesher
    example = folder / "share/limber/examples/struck_finger.toml"
    run_plainly(folder / "bin/limber", "check", example, folder=elsewhere)
    if (elsewhere / ".cache").exists():
        fail("a shipped body was made again")
    (folder / "hidden").rename(helpers)
    mesh = folder / "share/limber/meshes/capture_upper_link.geo"
    mesh.write_text(mesh.read_text() + "// changed\n")
    run_plainly(folder / "bin/limber", "check", example, folder=elsewhere)
    if not list((elsewhere / ".cache/limber").glob("*.mesh")):
        fail("a changed geometry was not meshed again")


def main():
    source, built = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(source / "scripts"))
    from packing import build, tarball
    check_versions(build, built / "src/app/limber")
    if shutil.which("patchelf") is None:
        print("skipped: there is no patchelf (scripts/install-deps --with-packaging)")
        sys.exit(SKIPPED)
    builds = build.Builds(built.parent)
    builds.whole = built
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        made = tarball.stage(builds, place / "work", "struck_finger")
        folder = place / "any where" / "limber"
        folder.parent.mkdir()
        made.rename(folder)
        elsewhere = place / "home"
        elsewhere.mkdir()
        check_libraries(folder)
        check_paths(folder, source, built, place / "work")
        check_manuals(folder)
        check_examples(folder, elsewhere)


main()
