# SPDX-License-Identifier: BSD-3-Clause
"""How far does the elbow bend as the strike of struck_finger.toml grows? Runs of its first 50 ms.

  struck_finger.py examples/struck_finger.toml
"""
import sys

import limber

scenario = limber.load(sys.argv[1], unset=["time.steps"],
                       set={"time.step": 1e-4, "time.duration": 0.05})
for force in (50.0, 100.0, 200.0):
    scenario["load.strike.force.2"] = -force
    bending, time = scenario.run().peaks["elbow_1_bending.dz"]
    print(f"{force:.0f} N: the elbow bends by {1e6 * abs(bending):.0f} um at {1e3 * time:.0f} ms")
