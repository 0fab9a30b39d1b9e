# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of MJCF for recipes of MuJoCo: scenes, and beams as rigid segments on springs."""


def scene(body, timestep, gravity="0 0 0", integrator="Euler", sensors="", more="", options=""):
    """A whole file."""
    return f"""<mujoco>
<compiler angle="radian" inertiafromgeom="false" coordinate="local" balanceinertia="false" eulerseq="XYZ"/>
<size njmax="200" nconmax="40"/>
<option timestep="{timestep:.12g}" gravity="{gravity}" integrator="{integrator}" cone="elliptic" \
impratio="10" tolerance="1e-14" iterations="200" {options}><flag energy="enable"/></option>
{more}
<worldbody>
{body}
</worldbody>
<sensor>
{sensors}
</sensor>
</mujoco>
"""


def inertial(mass, inertia, pos="0 0 0"):
    return f'<inertial pos="{pos}" mass="{mass:.12g}" diaginertia="{" ".join(f"{i:.12g}" for i in inertia)}"/>'


def beam(name, length, segments, mass_per_length, section, bends, inside, pos="0 0 0", stretch=None,
         root=None, euler="0 0 0", geoms="", damping=0.0):
    """A beam along x as rigid segments, clamped at its root in the parent's frame.

    section   (width along y, along z) [m], for the segments' inertia
    bends     {axis: E I}, axis "y" or "z" about which it bends [N m^2]
    stretch   E A [N] if it stretches
    root      MJCF of joints in place of the clamp
    inside    MJCF in the frame of the tip, which is bent like the beam's end
    geoms     MJCF for each segment, with {half} as half its length

    A spring of E I / h is between the middles of neighbours, twice that at the ends.
    Second order in h. Joints: name_AXIS_i; bodies: name_i, i from 0.
    """
    h = length / segments
    mass = mass_per_length * h
    wide, thick = section
    inertia = [mass / 12 * (wide**2 + thick**2), mass / 12 * (h**2 + thick**2), mass / 12 * (h**2 + wide**2)]

    def joints(i, factor):
        lines = []
        if stretch is not None:
            lines.append(f'<joint name="{name}_x_{i}" type="slide" axis="1 0 0" '
                         f'stiffness="{factor * stretch / h:.12g}"/>')
        for axis, stiffness in bends.items():
            way = "0 1 0" if axis == "y" else "0 0 1"
            k = factor * stiffness / h
            lines.append(f'<joint name="{name}_{axis}_{i}" type="hinge" axis="{way}" stiffness="{k:.12g}" '
                         f'damping="{damping * k:.12g}"/>')
        return "".join(lines)

    # The tip: a frame on springs of its own would need mass, so it is fixed to the last segment.
    text = f'<body name="{name}_tip" pos="{h:.12g} 0 0">{inside}</body>' if inside else ""
    for i in reversed(range(segments)):
        first = joints(0, 2.0) if i == 0 and root is None else root if i == 0 else joints(i, 1.0)
        at = pos if i == 0 else f"{h:.12g} 0 0"
        turn = f' euler="{euler}"' if i == 0 else ""
        own = geoms.format(half=0.5 * h)
        text = (f'<body name="{name}_{i}" pos="{at}"{turn}>{first}'
                f'{inertial(mass, inertia, f"{0.5 * h:.12g} 0 0")}{own}\n{text}</body>')
    return text


def spring_contact(duration):
    """Attributes of geoms whose contact is a linear spring without loss; an impact of two bodies lasts
    `duration` [s]. A low impedance makes neighbouring contacts independent springs. Without damping
    there is no friction: one damping serves both directions."""
    rate = 3.141592653589793 / duration
    return f'solref="{-rate * rate:.12g} 0" solimp="0.001 0.001 0.001 0.5 2" condim="1"'


def calibrate(simulate, half_period, stiffness):
    """The run of simulate(half period) whose contact has a stiffness [N/m].

    MuJoCo scales contacts by an estimate of the bodies' inertia at the start, which in chains is
    rough; so a first run finds what that makes of a half period.
    """
    run = simulate(half_period)
    i = max(range(len(run.time)), key=lambda i: run["contact_force"][i])
    found = run["contact_force"][i] / run["contact_depth"][i]
    return simulate(half_period * (found / stiffness) ** 0.5)
