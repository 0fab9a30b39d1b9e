# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that the tests share."""

import os
import pathlib
import subprocess
import warnings

import pytest

import limber

SOURCE = pathlib.Path(os.environ["LIMBER_SOURCE"])

SLED_ROBOT = """<robot name='r'><link name='world'/>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='0' velocity='0'/>
</joint>
<spring name='coil' stiffness='10' free_length='1'>
  <from link='world' point='-1 0 0'/><to link='sled'/></spring></robot>"""

SLED = """robot = 'robot.urdf'
[time]
duration = 0.5
step = 1e-3
output_interval = 0.01
[initial.joints]
rail = { position = 0.1 }
[[load]]
name = 'push'
link = 'sled'
force = [1, 0, 0]
[[probe]]
name = 'sled'
link = 'sled'
"""

ROTOR_ROBOT = """<robot name='r'><link name='world'/>
<link name='rotor'><inertial><mass value='2'/><inertia ixx='0.3' iyy='0.3'
  izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='hinge' type='continuous'><parent link='world'/>
  <child link='rotor'/><axis xyz='0 0 1'/></joint></robot>"""

ROTOR = """robot = 'robot.urdf'
[time]
duration = 1.0
step = 0.001
integrator = 'runge-kutta-4'
output_interval = 0.02
[initial.joints]
hinge = { position = 0.5 }
[[drive]]
joint = 'hinge'
mode = 'effort'
signal = { kind = 'input', controller = 'pd' }
[[controller]]
name = 'pd'
period = 0.02
measures = 'angle.q'
rate = 'speed.qdot'
proportional = 3.0
derivative = 1.2
[[probe]]
name = 'angle'
coupler = 'hinge'
quantity = 'coordinate'
[[probe]]
name = 'speed'
coupler = 'hinge'
quantity = 'coordinate_rate'
[[probe]]
name = 'torque'
controller = 'pd'
"""


@pytest.fixture(autouse=True)
def no_warnings():
    """Warnings of Limber are told, and no test asks for one unless it says so."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", limber.LimberWarning)
        yield


def place(folder, robot, scenario):
    (folder / "robot.urdf").write_text(robot)
    file = folder / "s.toml"
    file.write_text(scenario)
    return file


@pytest.fixture
def sled(tmp_path):
    """File of a mass on a spring."""
    return place(tmp_path, SLED_ROBOT, SLED)


@pytest.fixture
def rotor(tmp_path):
    """File of a rotor under PD control."""
    return place(tmp_path, ROTOR_ROBOT, ROTOR)


def call(*arguments, cwd=None):
    """The command's output."""
    return subprocess.run([os.environ["LIMBER_COMMAND"], *map(str, arguments)],
                          check=True, capture_output=True, text=True, cwd=cwd).stdout
