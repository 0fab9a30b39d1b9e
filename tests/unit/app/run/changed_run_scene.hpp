// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A scene with one of nearly everything: springs, a bushing, a latch, a
/// tendon, a gear, stops, friction, drives, loads, probes and a link that
/// bends.
namespace limber::app {

inline const char* const kRobot = R"(
<link name='world'/>
<link name='arm'/>
<link name='hand'><inertial><origin xyz='0.1 0.02 0.3' rpy='0 0 0.2'/>
  <mass value='4'/><inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0.01' ixz='0'
  iyz='0'/></inertial></link>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='wheel'><inertial><mass value='2'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='follower'><inertial><mass value='2'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='shoulder' type='revolute'><parent link='world'/>
  <child link='arm'/><origin xyz='0.5 0.5 0' rpy='0 0.1 0'/><axis xyz='0 1 0'/>
  <limit lower='-0.5' upper='0.6' effort='900' velocity='9'/>
  <dynamics damping='0.3' friction='0.1'/></joint>
<joint name='wrist' type='revolute'><parent link='arm'/><child link='hand'/>
  <origin xyz='0.5 0.5 5' rpy='0 0 0'/><axis xyz='0 1 0'/>
  <limit lower='-1' upper='1' effort='0' velocity='0'/></joint>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <origin xyz='3 0 0'/><axis xyz='1 0 0'/>
  <limit lower='-2' upper='2' effort='500' velocity='5'/></joint>
<joint name='axle' type='continuous'><parent link='world'/>
  <child link='wheel'/><origin xyz='6 0 0'/><axis xyz='0 0 1'/></joint>
<joint name='mate' type='continuous'><parent link='world'/>
  <child link='follower'/><origin xyz='6 3 0'/><axis xyz='0 0 1'/></joint>
<flexible link='arm'>
  <mesh file='BOX' size='1.2' order='2' unit='1'/>
  <material youngs_modulus='7e8' poisson_ratio='0.3' density='20'/>
  <damping ratio='0.02'/>
  <basis eigenmodes='3' terms='1' interface_modes='true'/>
  <interface name='root' group='root'/>
  <interface name='tip' group='tip' weighting='uniform'/>
  <attach joint='shoulder' interface='root'/>
  <attach joint='wrist' interface='tip'/>
</flexible>
<coupler joint='shoulder' translational_stiffness='1e6'
  rotational_stiffness='2e6' translational_damping='100'
  rotational_damping='200'>
  <spring stiffness='10' quadratic='2' damping='0.5' rest='0.1'/>
  <stop stiffness='800' restitution='0.4' speed='1.5'/>
  <friction coulomb='0.2' viscous='0.1' speed='0.01'/>
</coupler>
<coupler joint='wrist' translational_stiffness='1e6'
  rotational_stiffness='1e6' free_damping='0.2'>
  <spring table='-1 -8 0 0 1 9'/>
</coupler>
<coupler joint='rail' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<coupler joint='axle' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<coupler joint='mate' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<spring name='line' stiffness='50' damping='1' free_length='0.9'
  quadratic='3' tension_only='true'>
  <from link='world' point='3 1 0.2'/><to link='sled' point='0 0.1 0'/></spring>
<bushing name='mount' translational_stiffness='30 40 50'
  rotational_stiffness='3' translational_damping='0.2' rotational_damping='0.1'>
  <from link='world' point='3.1 0 -1'/><to link='sled' point='0 0 -1'/></bushing>
<latch name='hook' reach='0.3' translational_stiffness='2e4'
  rotational_stiffness='20' translational_damping='20' rotational_damping='0.1'
  release_force='4000' release_time='0.9'>
  <from link='world' point='4.4 0 0'/><to link='sled' point='1 0 0'/></latch>
<tendon name='rope' stiffness='400' damping='2' free_length='5'>
  <via link='world' point='0 0 1'/><via link='arm' interface='tip'/>
  <via link='hand' point='0.1 0 0.5'/></tendon>
<gear name='teeth' joint='axle' with='mate' ratio='-2' offset='0.1'
  stiffness='300' damping='1'/>
)";

inline const char* const kScenario = R"(
[time]
duration = 0.02
step = 1e-3
output_interval = 2e-3
rho_inf = 0.8
newton_tolerance = 1e-11
newton_iterations = 30
integrator = "generalized-alpha"
exact_modes = true

[fidelity]
default = "coupled"
links = { arm = "coupled" }

[full]
law = "st-venant-kirchhoff"
mass = "consistent"

[basis]
eigenmodes = 4

[gravity]
acceleration = [0.0, 0.3, -9.81]

[initial.joints]
shoulder = { position = 0.05, velocity = 0.4 }
rail = { position = 0.1, velocity = 2.0 }
axle = { velocity = 3.0 }

[initial.links]
arm = { modes = { position = [0.001], velocity = [0.1] } }

[[load]]
name = "push"
link = "hand"
point = [0.1, 0.0, 0.2]
force = [10.0, 0.0, -5.0]
moment = [0.1, 0.2, 0.3]
frame = "world"
time = { kind = "sinusoid", frequency = 3.0, phase = 0.2, from = 0.1, until = 9 }

[[load]]
name = "strike"
link = "arm"
interface = "tip"
force = [0.0, 20.0, 0.0]
time = { kind = "pulse", shape = "half-sine", start = 0.5, duration = 0.1 }

[[load]]
name = "sequence"
link = "sled"
force = [0.0, 1.0, 0.0]
time = { kind = "steps", times = [0.3, 0.4], values = [1.0, 0.5] }

[[load]]
name = "measured"
link = "sled"
force = [0.0, 0.0, 1.0]
time = { kind = "table", times = [0.3, 0.4], values = [1.0, 0.5] }

[[load]]
name = "waves"
link = "wheel"
moment = [0.0, 0.0, 1.0]
time = { kind = "sinusoids", frequencies = [2, 5], amplitudes = [1, 0.5], phases = [0.1, 0.3], mean = 0.2 }

[[drive]]
name = "motor"
joint = "shoulder"
mode = "position"
stiffness = 100.0
damping = 3.0
max_effort = 800.0
max_speed = 8.0
signal = { kind = "ramp", from = 0.05, to = 0.2, start = 0.1, duration = 0.8, shape = "trapezoid", rise = 0.3 }
shaper = { kind = "zv", frequency = 4.0, damping_ratio = 0.1 }

[[drive]]
joint = "rail"
mode = "effort"
signal = { kind = "sine", mean = 1.0, amplitude = 2.0, frequency = 7.0, phase = 0.1, start = 0.2 }

[[drive]]
tendon = "rope"
mode = "effort"
signal = { kind = "table", times = [0.1, 0.5], values = [3.0, 4.0] }

[[release]]
latch = "hook"
time = 0.7

[[probe]]
name = "tip"
link = "arm"
interface = "tip"
quantity = "displacement"

[[probe]]
name = "grip"
link = "hand"
point = [0.1, 0.0, 0.3]
quantity = "velocity"

[[probe]]
name = "knee"
coupler = "wrist"
quantity = "force"
side = "M"
frame = "F"

[advice]
displacement = 1e-6

[output]
folder = "here"
pictures = true
checkpoint_interval = 60
)";

}  // namespace limber::app
