# SPDX-License-Identifier: BSD-3-Clause
"""Tries packages in clean Debian systems, made of the archives that apt uses here."""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from . import build, deb, wheel

MOST_SECONDS = 10.0   # of the first example, on a machine that has nothing else to do
MOST_MEGABYTES = 300  # of packages beyond a minimal Debian
SHARE = "usr/share/limber"
EXAMPLE = "examples/struck_finger.toml"


class Failure(Exception):
    """What a trial found wrong."""


def expect(is_so, what):
    if not is_so:
        raise Failure(what)


class Root:
    """A Debian system in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.user = folder / "home/user"

    def run(self, command, is_user=False, **options):
        """A shell command in it, without our environment; output as text."""
        enter = ["chroot"] + (["--userspec=1234:1234"] if is_user else [])
        home = "/home/user" if is_user else "/root"
        whole = ["unshare", "--mount", "--pid", "--fork",
                 f"--mount-proc={self.folder}/proc", "env", "-i", f"HOME={home}",
                 "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND=noninteractive",
                 *enter, self.folder, "sh", "-c", f"cd {home} && {command}"]
        done = subprocess.run(whole, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, **options)
        expect(done.returncode == 0, f"'{command}' ended with status {done.returncode}:\n"
               f"{done.stdout[-3000:]}")
        return done.stdout

    def add(self, *files):
        for file in files:
            shutil.copy(file, self.user)
            os.chown(self.user / file.name, 1234, 1234)

    def list_files(self):
        return {str(file.relative_to(self.folder)) for top in ("usr", "etc", "var/lib", "opt")
                for file in (self.folder / top).rglob("*")
                if "var/lib/dpkg/" not in str(file) and "var/lib/apt/" not in str(file)}


def list_archives():
    """Lines of sources.list: Debian's, as apt knows them here."""
    return build.read("apt-get", "indextargets", "--format",
                      "deb $(REPO_URI) $(RELEASE) $(COMPONENT)",
                      "Created-By: Packages", "Origin: Debian")


@contextlib.contextmanager
def make_root(store):
    """A fresh copy of a minimal system, which is made once."""
    archive = store / "base.tar"
    if not archive.exists():
        build.run("mmdebstrap", "--quiet", "--variant=minbase", "", archive, "-",
                  input=list_archives(), text=True)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="root-", dir=store))
    try:
        build.run("tar", "-C", folder, "-xf", archive)
        shutil.copy("/etc/resolv.conf", folder / "etc/resolv.conf")
        root = Root(folder)
        root.user.mkdir()
        os.chown(root.user, 1234, 1234)
        yield root
    finally:
        shutil.rmtree(folder)


def time_example(root, command, scenario):
    """Runs it as an ordinary user; @returns seconds"""
    begin = time.monotonic()
    root.run(f"{command} run {scenario} --out out", is_user=True)
    seconds = time.monotonic() - begin
    expect((root.user / "out/summary.json").exists(), "the run has left no summary.json")
    expect(seconds < MOST_SECONDS, f"the example took {seconds:.1f} s")
    return seconds


def try_page(root, command, share):
    """A page that simulates, if its module was made; `share` is a path as the ordinary user sees it."""
    if not (root.user / share / "playground.wasm").exists():
        print("  no page that simulates: the package was made without emscripten")
        return
    root.run(f"{command} view --play '{share}/{EXAMPLE}' -o play.html", is_user=True)
    size = (root.user / "play.html").stat().st_size / 1e6
    expect(size > 1.0, f"the page that simulates has only {size:.1f} MB")
    print(f"  a page that simulates: {size:.1f} MB")


def find_growth(text):
    size = re.search(r"After this operation, ([\d.,]+) ([kM])B of additional", text)
    return float(size.group(1).replace(",", "")) * {"k": 1e-3, "M": 1.0}[size.group(2)]


def try_deb(dist, store):
    def file(name):
        return dist / f"{name}_{build.VERSION}_amd64.deb"
    names = list(deb.PACKAGES)
    with make_root(store) as root:
        root.run("apt-get update")
        before = root.list_files()
        root.add(*map(file, names))
        text = root.run(f"apt-get install -y ./{file('limber').name}".replace(
            "./", "/home/user/"))
        megabytes = find_growth(text)
        expect(megabytes <= MOST_MEGABYTES, f"installs {megabytes:.0f} MB")
        print(f"  limber installs {megabytes:.0f} MB, itself included")
        seconds = time_example(root, "limber", f"/{SHARE}/{EXAMPLE}")
        print(f"  first example: {seconds:.1f} s")
        try_page(root, "limber", f"../../{SHARE}")
        root.run(f"cp -r /{SHARE}/examples /{SHARE}/models /{SHARE}/meshes .", is_user=True)
        root.run("sed -i 's/0.8/0.81/' meshes/capture_upper_link.geo", is_user=True)
        asks = root.run("limber check examples/struck_finger.toml || true", is_user=True)
        expect("limber-mesher" in asks, f"a changed mesh needs limber-mesher; it said: {asks}")
        root.run("apt-get install -y --no-install-recommends "
                 + " ".join(f"/home/user/{file(name).name}" for name in names[1:]))
        root.run("limber check examples/struck_finger.toml", is_user=True)
        root.run("limber verify examples/report_beam.toml --duration 0.01", is_user=True)
        root.run("python3 -c 'import limber; limber.load(\"examples/struck_finger.toml\")"
                 ".check()'", is_user=True)
        root.run("limber --help; bash -c '. /usr/share/bash-completion/completions/limber'")
        print("  mesher, verifier, Python module: work")
        shutil.copytree(build.SOURCE / "tests/install/consumer", root.folder / "root/consumer")
        root.run("apt-get install -y --no-install-recommends g++ cmake make libgmsh-dev"
                 " libsimbody-dev && cmake -DCMAKE_PREFIX_PATH=/usr -S consumer -B consumer/build"
                 " && cmake --build consumer/build && consumer/build/spin && consumer/build/reduce")
        print("  a C++ program builds with liblimber-dev, and runs")
        root.run(f"apt-get purge -y {' '.join(names)}")
        root.run("apt-get autoremove -y --purge")
        left = sorted(name for name in root.list_files() - before if "limber" in name)
        expect(not left, f"left after purge: {left[:10]}")
        print("  purge leaves nothing")


def try_tarball(dist, store):
    with make_root(store) as root:
        file = dist / f"limber-{build.VERSION}-linux-x86_64.tar.gz"
        root.add(file)
        root.run(f"mkdir 'any where' && cd 'any where' && tar -xf ../{file.name}", is_user=True)
        folder = f"'any where'/limber-{build.VERSION}"
        seconds = time_example(root, f"{folder}/bin/limber", f"{folder}/share/limber/{EXAMPLE}")
        print(f"  first example, by an ordinary user without any package: {seconds:.1f} s")
        try_page(root, f"{folder}/bin/limber", f"any where/limber-{build.VERSION}/share/limber")
        root.run(f"sed -i 's/0.8/0.81/' {folder}/share/limber/meshes/capture_upper_link.geo"
                 f" && {folder}/bin/limber check {folder}/share/limber/{EXAMPLE}", is_user=True)
        root.run(f"{folder}/bin/limber verify {folder}/share/limber/examples/report_beam.toml"
                 " --duration 0.01", is_user=True)
        print("  a changed mesh is meshed and reduced; verify works")


def try_wheel(dist, store):
    with make_root(store) as root:
        root.run("apt-get update && apt-get install -y --no-install-recommends python3-venv"
                 " python3-numpy")
        root.add(*dist.glob("limber*.whl"))
        for name in ("examples", "models", "meshes"):
            shutil.copytree(build.SOURCE / name, root.user / name)
        root.run("python3 -m venv --system-site-packages env && env/bin/pip install --no-index"
                 " ./limber-*.whl", is_user=True)
        root.run("env/bin/python -c 'import limber;"
                 " limber.load(\"examples/joint_chain.toml\").run()'", is_user=True)
        asks = root.run("env/bin/python -c 'import limber;"
                        " limber.load(\"examples/struck_finger.toml\").check()' || true",
                        is_user=True)
        expect("limber[reduction]" in asks, f"reduction is an extra; it said: {asks}")
        root.run("env/bin/pip install --no-index --find-links . 'limber[reduction]'", is_user=True)
        root.run("env/bin/python -c 'import limber;"
                 " limber.load(\"examples/struck_finger.toml\").check()'", is_user=True)
        print("  wheel runs; limber[reduction] meshes and reduces")
        root.run("env/bin/pip uninstall -y limber limber-reduction", is_user=True)
        left = sorted(str(file) for file in (root.user / "env").rglob("*limber*"))
        expect(not left, f"left after uninstallation: {left}")


FILES = {
    "deb": [f"{name}_{build.VERSION}_amd64.deb" for name in deb.PACKAGES],
    "tarball": [f"limber-{build.VERSION}-linux-x86_64.tar.gz"],
    "wheel": [f"{name.replace('-', '_')}-{build.VERSION}-{wheel.TAG}.whl" for name in wheel.WHEELS]}
TRIALS = {"deb": try_deb, "tarball": try_tarball, "wheel": try_wheel}


def run(dist, kinds):
    """@returns exit status"""
    missing = [str(dist / file) for kind in kinds for file in FILES[kind] if not (dist / file).is_file()]
    if missing:
        print(f"package: nothing to try: {', '.join(missing)} not found; without --try they are made", file=sys.stderr)
        return 2
    if os.geteuid() != 0 or shutil.which("mmdebstrap") is None:
        print("package: skipped: a clean root needs root and mmdebstrap")
        return 0
    store = pathlib.Path(tempfile.mkdtemp(prefix="limber-try-", dir="/var/tmp"))
    failures = 0
    try:
        for kind in kinds:
            print(f"== {kind}", flush=True)
            try:
                TRIALS[kind](dist, store)
            except Failure as failure:
                failures += 1
                print(f"  FAILED: {failure}")
    finally:
        shutil.rmtree(store)
    if failures == 0:
        print("all packages work")
    return 1 if failures else 0
