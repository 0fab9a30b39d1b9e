#!/usr/bin/env python3
"""The page of `limber view` in headless Chromium, or the glTF scene of `limber
export` in readers that are not ours: check.py page|gltf|stress|full_stress|far LIMBER
SCENARIO NODE NODE_MODULES FOLDER. Ends with 77, and says why, where packages of node, Chromium
or h5py are missing.

The reference are positions of 100 random surface points at 20 random outputs,
from the file for ParaView that the library writes.
"""
import json
import os
import random
import shutil
import subprocess
import sys

SKIPPED = 77


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def list_points(folder):
    """Random points of the bodies' surfaces and where they are, by motion.h5."""
    import h5py
    import numpy as np
    rng = random.Random(7)
    with h5py.File(f"{folder}/motion.h5") as motion, \
            h5py.File(f"{folder}/results.h5") as results:
        times = results["time"][:, 0]
        scene = results["scene"]
        names = sorted(scene["bodies"], key=lambda n: scene["bodies"][n]["place"][0])
        corners = np.unique(motion["triangles"][:])  # rows on surfaces, in order
        rows = []  # of each point: body, node, row in motion.h5
        first = 0
        for name in names:
            if "surface" not in scene["bodies"][name]:
                continue
            surface = scene["bodies"][name]["surface"][()].decode()
            count = len(scene["surfaces"][surface]["tags"])
            for node in range(count):
                rows.append((name, node, int(corners[first + node])))
            first += count
        assert first == len(corners), "surfaces of motion.h5 and results.h5 differ"
        points = rng.sample(rows, min(100, len(rows)))
        outputs = sorted(rng.sample(range(len(times)), min(20, len(times))))
        list_ = []
        for i in outputs:
            at = motion[f"steps/{i:06d}/points"][:] + motion["offset"][:]
            for name, node, row in points:
                list_.append({"time": times[i], "output": i, "body": name, "node": node,
                              "position": at[row].tolist()})
    return list_


def find_largest(folder):
    """Largest deformation and speed of the nodes on surfaces, and the output of the first."""
    import h5py
    import numpy as np
    largest = {"deformation": 0.0, "time": 0.0, "velocity": 0.0}
    with h5py.File(f"{folder}/results.h5") as results:
        times = results["time"][:, 0]
        for name, drawn in results["scene/bodies"].items():
            body = results["bodies"][name]
            if "surface" not in drawn:
                continue
            surface = results["scene/surfaces"][drawn["surface"][()].decode()]
            shapes, x = surface["Phi_B"][:], surface["x_B"][:].T
            for i, t in enumerate(times):
                u = (shapes @ body["eta"][i]).reshape(-1, 3)
                deformation = np.linalg.norm(u, axis=1).max()
                if deformation > largest["deformation"]:
                    largest.update(deformation=deformation, time=t)
                w, *v = body["quat_WB"][i]
                turned = body["v_WB_W"][i]
                turned = turned + 2 * np.cross(v, np.cross(v, turned) - w * turned)  # body frame
                velocity = (turned + np.cross(body["w_WB_B"][i], x + u)
                            + (shapes @ body["etadot"][i]).reshape(-1, 3))
                largest["velocity"] = max(largest["velocity"],
                                          np.linalg.norm(velocity, axis=1).max())
    return largest


def check_script(folder, points):
    """The script of docs/reference/view.md against the library, at the last output."""
    import h5py
    import numpy as np
    here = os.path.dirname(os.path.abspath(__file__))
    with open(f"{here}/../../docs/reference/view.md") as page:
        script = page.read().split("```python\n")[1].split("```")[0]
    with h5py.File(f"{folder}/results.h5") as results:
        names = [n for n, body in results["scene/bodies"].items() if "surface" in body]
    chosen = 'next(name for name, body in f["scene/bodies"].items() if "surface" in body)'
    assert chosen in script and '"out/struck_finger/results.h5"' in script
    script = script.replace(chosen, "given").replace("out/struck_finger/", "")
    for given in names:
        for wanted in (p for p in points if p["body"] == given):
            scope = {"given": given}
            at = os.getcwd()
            os.chdir(folder)
            exec(script.replace("i = -1 ", f"i = {wanted['output']} "), scope)
            os.chdir(at)
            gap = np.linalg.norm(scope["points"][wanted["node"]] - wanted["position"])
            assert gap < 1e-7, (given, wanted, gap)
            break
        else:
            assert False, f"no point of {given}"


# Place [m] and velocity [m/s] of an arm that begins at (0, 0, 0.3) with (0.2, 0.1, -0.3).
FLIGHTS = {
    "near": ([0, 0, 0.3], [0.2, 0.1, -0.3]),
    "map": ([3e5, -2e5, 5e5 + 0.3], [0.2, 0.1, -0.3]),
    "far": ([1e7, 0, 0.3], [0.2, 0.1, -0.3]),
    "beside": ([1e7, 0.05, 0.3], [0.2, 0.1, -0.3]),
    "fast": ([0, 0, 0.3], [7500.2, 0.1, -0.3]),
}


def check_far(run, scenario, folder):
    """Pages of one arm at several places, for drive_far.mjs."""
    data = os.path.dirname(scenario)
    for name in os.listdir(data):
        shutil.copy(f"{data}/{name}", folder)
    with open(scenario) as file:
        text = file.read()
    for name, (place, velocity) in FLIGHTS.items():
        moved = text.replace("[0.0, 0.0, 0.3]", str(place)).replace("[0.2, 0.1, -0.3]", str(velocity))
        assert name == "near" or moved != text
        with open(f"{folder}/{name}.toml", "w") as out:
            out.write(moved)
        run("run", f"{folder}/{name}.toml", "--out", f"{folder}/{name}", "--xdmf",
            "--cache", f"{folder}/cache")
        with open(f"{folder}/{name}.json", "w") as out:
            json.dump(list_points(f"{folder}/{name}"), out)
        run("view", f"{folder}/{name}", "-o", f"{folder}/{name}.html")
    run("view", f"{folder}/far", "--with", f"{folder}/beside", "-o", f"{folder}/ghost.html")


def find_chromium():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        skip("Chromium is not installed; scripts/install-deps --with-chromium")
    return chromium


def main():
    what, limber, scenario, node, modules, folder = sys.argv[1:7]
    try:
        import h5py  # noqa: F401
    except ImportError:
        skip("python3-h5py is not installed")
    if not os.path.isdir(f"{modules}/playwright-core"):
        skip("npm could not fetch the packages of the page")
    chromium = None if what == "gltf" else find_chromium()
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)

    def run(*arguments):
        subprocess.run([limber, *arguments], check=True, stdout=subprocess.DEVNULL)
    cache = ["--cache", f"{folder}/cache"]
    here = os.path.dirname(os.path.abspath(__file__))
    if what in ("stress", "full_stress"):
        more = []
        if what == "full_stress":
            more = ["--fidelity", "full", "--set", "time.step=0.0001"]
        run("run", scenario, "--out", f"{folder}/run", *more, *cache)
        page = f"{folder}/page.html"
        run("view", f"{folder}/run", "-o", page)
        sys.exit(subprocess.run([node, f"{here}/drive_stress.mjs", modules, page, chromium,
                                 folder]).returncode)
    if what == "far":
        check_far(run, os.path.abspath(scenario), folder)
        sys.exit(subprocess.run([node, f"{here}/drive_far.mjs", modules, chromium,
                                 folder]).returncode)
    run("run", scenario, "--out", f"{folder}/run", "--xdmf", *cache)
    points = f"{folder}/points.json"
    with open(points, "w") as out:
        json.dump(list_points(f"{folder}/run"), out)
    with open(f"{folder}/largest.json", "w") as out:
        json.dump(find_largest(f"{folder}/run"), out)
    if what == "page":
        run("run", scenario, "--out", f"{folder}/rigid", "--fidelity", "rigid", *cache)
        page = f"{folder}/page.html"
        run("view", f"{folder}/run", "--with", f"{folder}/rigid", "-o", page)
        command = ["drive_page.mjs", modules, page, points, chromium, folder]
    else:
        check_script(f"{folder}/run", list_points(f"{folder}/run"))
        run("export", f"{folder}/run", "-o", f"{folder}/scene.glb")
        command = ["check_gltf.mjs", modules, f"{folder}/scene.glb", points]
    result = subprocess.run([node, f"{here}/{command[0]}", *command[1:]])
    sys.exit(result.returncode)


main()
