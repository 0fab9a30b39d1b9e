# SPDX-License-Identifier: BSD-3-Clause
"""What a package contains of others: CycloneDX (sbom.cdx.json) and licence texts."""
import functools
import json
import pathlib
import re
import subprocess

from . import build

# Compiled in as headers, or part of the page: Debian package, or npm's, and SPDX licence.
HEADERS = {
    "core": {"libeigen3-dev": "MPL-2.0", "libcli11-dev": "BSD-3-Clause",
             "nlohmann-json3-dev": "MIT"},
    "reduction": {"libspectra-dev": "MPL-2.0"},
    "python": {"pybind11-dev": "BSD-3-Clause"},
    # The module of limber view --play, with emscripten's C and C++ libraries.
    "playground": {"emscripten": "MIT", "liburdfdom-model3.0": "BSD-3-Clause",
                   "libtinyxml2.6.2v5": "Zlib", "libconsole-bridge1.0": "BSD-3-Clause",
                   "libfmt-dev": "MIT", "libxxhash-dev": "BSD-2-Clause",
                   "libtomlplusplus-dev": "MIT"},
}
PAGE = {"three": "MIT", "uplot": "MIT"}
# Libraries that Limber calls itself; of others the names in their copyright files are listed.
LICENCES = {
    "libfmt9": "MIT", "libhdf5-103-1": "BSD-3-Clause", "libxxhash0": "BSD-2-Clause",
    "liburdfdom-model3.0": "BSD-3-Clause", "libtinyxml2.6.2v5": "Zlib",
    "libtomlplusplus3": "MIT", "zlib1g": "Zlib", "libmatio11": "BSD-2-Clause",
    "libsqlite3-0": "blessing", "libmuparser2v5": "BSD-2-Clause",
    "libconsole-bridge1.0": "BSD-3-Clause", "libgmsh4.8": "GPL-2.0-or-later",
    "libcholmod3": "GPL-2.0-or-later", "libopenblas0-pthread": "BSD-3-Clause",
    "libsimbody3.7": "Apache-2.0", **HEADERS["core"], **HEADERS["reduction"],
    **HEADERS["python"], **HEADERS["playground"], **PAGE}
# Part of every Debian, and of every Linux that runs what is made here.
SYSTEM = re.compile(r"/(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|anl))\.so")

# limber loads it by this name (src/limber/fem/linalg/cholmod_library.cpp).
CHOLMOD = pathlib.Path("/usr/lib/x86_64-linux-gnu/libcholmod.so.3")


def list_libraries(*programs):
    """Shared libraries that programs load, by file name, without the C library's."""
    found = {}
    for program in programs:
        for line in build.read("ldd", program).splitlines():
            if "not found" in line:
                raise SystemExit(f"package: {program}: {line.strip()}")
            match = re.search(r"^\s*(\S+) => (/\S+)", line)
            if match and not SYSTEM.search(match.group(2)):
                found[match.group(1)] = pathlib.Path(match.group(2)).resolve()
    return dict(sorted(found.items()))


def list_headers(builds, groups):
    """Groups of HEADERS in a package that has the command."""
    return groups + (["playground"] if builds.has_playground else [])


def find_packages(files):
    """{file: the Debian package that it is of}."""
    # Debian lists files where they were before /lib became /usr/lib.
    places = {str(file).removeprefix(prefix): file for file in files for prefix in ("", "/usr")}
    asked = subprocess.run(["dpkg-query", "-S", *places], capture_output=True, text=True)
    found = {}
    for line in asked.stdout.splitlines():
        packages, place = line.split(": ", 1)
        found[places[place]] = packages.split(",")[0].split(":")[0]
    missing = [str(file) for file in files if file not in found]
    if missing:
        raise SystemExit(f"package: of no Debian package: {', '.join(missing)}")
    return found


@functools.cache
def find_version(name):
    return build.read("dpkg-query", "-W", "-f", "${Version}\n", name).split()[0]


def read_copyright(package):
    return pathlib.Path("/usr/share/doc", package, "copyright").read_text(errors="replace")


def describe_licence(package):
    known = LICENCES.get(package)
    if known:
        return [{"license": {"id": known}}]
    names = re.findall(r"^License: *(\S.*)$", read_copyright(package), re.M)
    names = sorted(set(names)) or [f"see LICENSES/{package}.txt"]
    return [{"license": {"name": name}} for name in names]


def list_parts(libraries, headers):
    """{Debian package: version} of libraries (files) and of header-only ones."""
    libraries = list(libraries)
    parts = {name: find_version(name) for name in find_packages(libraries).values()}
    for group in headers:
        parts.update({name: find_version(name) for name in HEADERS[group]})
    return dict(sorted(parts.items()))


def read_page_versions():
    lock = json.loads((build.SOURCE / "src/limber/view/page/package-lock.json").read_text())
    return {name: lock["packages"][f"node_modules/{name}"]["version"] for name in PAGE}


def write_sbom(file, name, licence, parts, has_page):
    """CycloneDX 1.4; without a serial number, which would differ each time."""
    components = [
        {"type": "library", "name": package, "version": version,
         "purl": f"pkg:deb/debian/{package}@{version}?arch=amd64&distro=debian-12",
         "licenses": describe_licence(package)} for package, version in parts.items()]
    if has_page:
        components += [
            {"type": "library", "name": package, "version": version,
             "purl": f"pkg:npm/{package}@{version}", "licenses": describe_licence(package)}
            for package, version in read_page_versions().items()]
    document = {
        "bomFormat": "CycloneDX", "specVersion": "1.4", "version": 1,
        "metadata": {
            "timestamp": f"{build.RELEASED}T00:00:00Z",
            "component": {"type": "application", "name": name, "version": build.VERSION,
                          "licenses": [{"expression": licence}]}},
        "components": components}
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(document, indent=1) + "\n")


def list_compiled_in(headers, has_page, builds):
    """(name, text) of each licence of what is compiled into a package."""
    texts = [(name, read_copyright(name)) for group in headers for name in HEADERS[group]]
    if has_page:
        modules = builds.whole / "src/view/page/node_modules"
        texts += [(name, (modules / name / "LICENSE").read_text()) for name in PAGE]
    return texts
