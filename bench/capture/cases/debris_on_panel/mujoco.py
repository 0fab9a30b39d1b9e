"""MuJoCo: a rigid plate. Its contact is a linear spring; its period is that of Hertz for two rigid
bodies (closed form), because nothing else is known beforehand."""
import ball_strike

VARIANTS = ("rigid",)


def measure(mujoco, _):
    return ball_strike.strike(mujoco, (0.2, 0.2, 0.004), 1.5e-4)
