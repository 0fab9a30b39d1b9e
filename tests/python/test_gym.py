# SPDX-License-Identifier: BSD-3-Clause
"""The vector environment on a batch: with Gymnasium if it is installed, else with a
stand-in of what it uses of it."""

import importlib.util
import subprocess
import sys

import gymnasium_stand_in
import numpy
import pytest

import limber

HAS_GYMNASIUM = importlib.util.find_spec("gymnasium") is not None
if not HAS_GYMNASIUM:
    gymnasium_stand_in.install()

import limber.gym  # noqa: E402
from limber.gym import AutoresetMode, BatchEnv  # noqa: E402


def reward(observations, actions):
    return -observations[:, 0]**2 - 1e-3 * actions[:, 0]**2


@pytest.fixture
def batch(rotor):
    return limber.Batch(limber.load(rotor, set={"time.duration": 0.1}), 3)


def actions(*values):
    return numpy.array([[value] for value in values])


@pytest.mark.skipif(not HAS_GYMNASIUM, reason="the package gymnasium is not installed; "
                    "the other tests use a stand-in")
def test_it_is_a_vector_environment_of_gymnasium(batch):
    import gymnasium
    env = BatchEnv(batch, reward, low=-2.0, high=2.0)
    assert isinstance(env, gymnasium.vector.VectorEnv)
    env.action_space.seed(1)
    observations, _ = env.reset(seed=1)
    assert observations in env.observation_space
    observations, *_ = env.step(env.action_space.sample())
    assert observations in env.observation_space


def test_limber_alone_does_not_import_it():
    code = "import sys, limber; sys.exit('gymnasium' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_without_the_package_the_import_tells_what_is_missing():
    code = ("import sys; sys.modules['gymnasium'] = None\n"
            "try:\n    import limber.gym\n"
            "except ImportError as error:\n    print(error)")
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "needs the Python package gymnasium" in told.stdout


def test_spaces_have_the_columns_and_inputs_of_the_batch(batch):
    env = BatchEnv(batch, reward, low=-2.0, high=[3.0])
    assert env.num_envs == 3
    assert env.single_observation_space.shape == (len(batch.columns),)
    assert env.observation_space.shape == (3, len(batch.columns))
    assert env.action_space.shape == (3, 1)
    assert env.single_action_space.low == -2.0 and env.single_action_space.high == 3.0
    with pytest.raises(limber.InputError, match="low: shape"):
        BatchEnv(batch, reward, low=[-1.0, -1.0])


def test_steps_are_those_of_the_batch_with_actions_within_their_bounds(batch, rotor):
    env = BatchEnv(batch, reward, low=-2.0, high=2.0)
    first, infos = env.reset(seed=1)
    assert infos == {} and first[:, 0] == pytest.approx([0.5, 0.5, 0.5])
    observations, rewards, terminations, truncations, infos = env.step(actions(1, -1, 9))
    other = limber.Batch(rotor, 3)
    other.step(actions(1.0, -1.0, 2.0))
    assert numpy.array_equal(observations, other.observations)
    assert numpy.array_equal(rewards, reward(observations, actions(1.0, -1.0, 2.0)))
    assert not terminations.any() and not truncations.any() and infos == {}
    env.step(actions(0, 0, 0))
    assert not numpy.array_equal(observations, batch.observations)  # it was a copy


def test_an_ended_episode_starts_again_in_the_next_step(batch):
    env = BatchEnv(batch, reward)
    assert env.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP
    first, _ = env.reset()
    for _ in range(4):
        *_, truncations, _ = env.step(actions(1, 2, 3))
        assert not truncations.any()
    last, _, terminations, truncations, _ = env.step(actions(1, 2, 3))
    assert truncations.all() and not terminations.any()
    assert not numpy.array_equal(last, first)
    again, rewards, _, truncations, _ = env.step(actions(1, 2, 3))
    assert numpy.array_equal(again, first) and not truncations.any()
    assert rewards.tolist() == [0.0, 0.0, 0.0]


def test_a_terminated_world_starts_again_alone(batch):
    env = BatchEnv(batch, reward, lambda observations: observations[:, 1] > 0.05)
    first, _ = env.reset()
    _, _, terminations, truncations, _ = env.step(actions(0, 3, 0))
    assert terminations.tolist() == [False, True, False] and not truncations.any()
    observations, rewards, *_ = env.step(actions(0, 3, 0))
    assert numpy.array_equal(observations[1], first[1])
    assert rewards[1] == 0.0 and rewards[0] != 0.0
    assert batch.time == pytest.approx([0.04, 0.0, 0.04])


def test_in_the_same_step_the_last_observation_is_in_the_infos(batch):
    env = BatchEnv(batch, reward, lambda observations: observations[:, 1] > 0.05,
                   autoreset=AutoresetMode.SAME_STEP)
    first, _ = env.reset()
    observations, _, terminations, _, infos = env.step(actions(0, 3, 0))
    assert terminations.tolist() == [False, True, False]
    assert numpy.array_equal(observations[1], first[1])
    assert infos["_final_obs"].tolist() == [False, True, False]
    assert infos["final_obs"][1, 1] > 0.05


def test_without_autoreset_worlds_start_again_when_asked(batch):
    env = BatchEnv(batch, reward, autoreset=AutoresetMode.DISABLED)
    first, _ = env.reset()
    for _ in range(5):
        env.step(actions(1, 2, 3))
    with pytest.raises(limber.InputError, match="at the end"):
        env.step(actions(1, 2, 3))
    mask = numpy.array([True, False, True])
    observations, _ = env.reset(options={"reset_mask": mask})
    assert numpy.array_equal(observations[mask], first[mask])
    assert not numpy.array_equal(observations[1], first[1])


def test_starts_are_drawn_by_the_seed(batch):
    def start(random, n):
        return {"joints": {"hinge": {"position": random.uniform(-1.0, 1.0, n)}}}
    env = BatchEnv(batch, reward, start=start)
    first, _ = env.reset(seed=7)
    same, _ = env.reset(seed=7)
    other, _ = env.reset(seed=8)
    assert numpy.array_equal(first, same) and not numpy.array_equal(first, other)
    assert len(set(first[:, 0])) == 3


def test_a_failed_world_is_terminated_with_its_last_finite_observation(batch):
    env = BatchEnv(batch, reward, failed_reward=-7.0)
    first, _ = env.reset()
    observations, rewards, terminations, _, infos = env.step(actions(1, numpy.nan, 1))
    assert terminations.tolist() == [False, True, False]
    assert numpy.array_equal(observations[1], first[1]) and rewards[1] == -7.0
    assert numpy.isfinite(observations).all() and numpy.isfinite(rewards).all()
    assert infos["_failure"].tolist() == [False, True, False]
    assert "nan" in infos["failure"][1] and infos["failure"][0] is None
    env.step(actions(1, 1, 1))
    assert not batch.failed.any()


def test_rewards_of_another_shape_are_told(batch):
    env = BatchEnv(batch, lambda observations, actions: 1.0)
    env.reset()
    with pytest.raises(limber.InputError, match=r"reward\(\) returned shape \(\)"):
        env.step(actions(1, 1, 1))
