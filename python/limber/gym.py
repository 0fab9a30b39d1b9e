# SPDX-License-Identifier: BSD-3-Clause
"""A batch as a Gymnasium vector environment. Needs the package gymnasium, which is
imported here and nowhere else.

    import limber.gym
    env = limber.gym.BatchEnv(batch, reward, terminated)
"""

import numpy

try:
    import gymnasium
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError as error:
    raise ImportError("limber.gym needs the Python package gymnasium, 1.1 or later "
                      "(pip install gymnasium)") from error

from .errors import InputError


class BatchEnv(VectorEnv):
    """The worlds of a :class:`limber.Batch` as sub-environments.

    ``reward(observations, actions)``: (n,), of the observations after the step, (n, k),
    and its actions, (n, m). ``terminated(observations)``: (n,) of bool, worlds that have
    reached a final state; by default none. Both get copies of all worlds' rows; rows of
    worlds that are not stepped are not used.

    ``start(random, n)``: arguments of :meth:`limber.Batch.reset` as a dictionary, for n
    worlds, drawn from a ``numpy.random.Generator``; by default worlds start as the
    scenario does. ``low``, ``high``: bounds of actions, numbers or (m,); actions beyond
    them are clipped. ``steps``: control periods to an action. ``failed_reward``: reward
    of the step in which a world fails.

    An episode ends by ``terminated``, or is truncated at the end of the scenario
    (``time.duration``). A world that fails is terminated, with its last finite
    observation, and why in ``infos["failure"]``.

    ``autoreset``, of ``gymnasium.vector.AutoresetMode``, says when a world whose episode
    has ended starts again: ``NEXT_STEP`` (default), in the next call of step, which
    ignores its action and returns its first observation and reward 0; ``SAME_STEP``, at
    once, the last observation then being in ``infos["final_obs"]``; ``DISABLED``, when
    ``reset(options={"reset_mask": mask})`` is called.
    """

    def __init__(self, batch, reward, terminated=None, start=None, low=-numpy.inf,
                 high=numpy.inf, steps=1, failed_reward=0.0,
                 autoreset=AutoresetMode.NEXT_STEP):
        self.batch = batch
        self.num_envs = len(batch)
        self.metadata = {"autoreset_mode": AutoresetMode(autoreset)}
        self._reward = reward
        self._terminated = terminated
        self._start = start
        self._steps = steps
        self._failed_reward = failed_reward
        inputs, columns = len(batch.inputs), len(batch.columns)
        self._low = _to_bound("low", low, inputs)
        self._high = _to_bound("high", high, inputs)
        box = gymnasium.spaces.Box
        self.single_observation_space = box(-numpy.inf, numpy.inf, (columns,), numpy.float64)
        self.single_action_space = box(self._low, self._high, (inputs,), numpy.float64)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._done = numpy.zeros(self.num_envs, dtype=bool)
        self._observations = numpy.array(batch.observations)

    def reset(self, *, seed=None, options=None):
        """Starts all worlds, or those of ``options["reset_mask"]``, (n,) of bool.
        ``seed`` is that of ``start``'s generator. Returns observations and infos."""
        super().reset(seed=seed)
        mask = (options or {}).get("reset_mask")
        if mask is None:
            mask = numpy.ones(self.num_envs, dtype=bool)
        self._reset_worlds(mask)
        return self._observations.copy(), {}

    def step(self, actions):
        """Steps all worlds by one action each, (n, m). Returns observations, rewards,
        terminations, truncations and infos."""
        mode = self.metadata["autoreset_mode"]
        fresh = self._done.copy() if mode == AutoresetMode.NEXT_STEP else numpy.zeros_like(
            self._done)
        if fresh.any():
            self._reset_worlds(fresh)
        actions = numpy.clip(actions, self._low, self._high)
        moved = ~fresh & ~self.batch.failed
        self.batch.step(actions, steps=self._steps, mask=moved)
        failed = self.batch.failed & moved
        moved = moved & ~failed
        self._observations[moved] = self.batch.observations[moved]

        rewards = numpy.where(failed, self._failed_reward, 0.0)
        rewards[moved] = _to_column("reward", self._reward(
            self._observations.copy(), actions), self.num_envs)[moved]
        terminations = failed.copy()
        if self._terminated is not None:
            terminations[moved] = _to_column("terminated", self._terminated(
                self._observations.copy()), self.num_envs)[moved]
        truncations = self.batch.ended & moved & ~terminations
        infos = self._describe_failures(failed)
        self._done = terminations | truncations
        if mode == AutoresetMode.SAME_STEP and self._done.any():
            infos.update(final_obs=self._observations.copy(), _final_obs=self._done.copy())
            self._reset_worlds(self._done.copy())
        return self._observations.copy(), rewards, terminations, truncations, infos

    def _reset_worlds(self, mask):
        start = {} if self._start is None else self._start(self.np_random, self.num_envs)
        observations = self.batch.reset(mask, **start)
        self._observations[mask] = observations[mask]
        self._done[mask] = False

    def _describe_failures(self, failed):
        if not failed.any():
            return {}
        texts = numpy.full(self.num_envs, None, dtype=object)
        for world, text in self.batch.failures.items():
            texts[world] = text
        return {"failure": texts, "_failure": failed}


def _to_bound(name, value, inputs):
    bound = numpy.asarray(value, dtype=numpy.float64)
    if bound.shape not in ((), (inputs,)):
        raise InputError(f"{name}: shape {bound.shape}; expected a number or ({inputs},), "
                         "one for each input")
    return numpy.broadcast_to(bound, (inputs,)).copy()


def _to_column(name, values, count):
    column = numpy.asarray(values)
    if column.shape != (count,):
        raise InputError(f"{name}() returned shape {column.shape}; expected ({count},), one "
                         "for each world")
    return column
