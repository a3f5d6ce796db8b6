"""The numbers that write_sample puts into its file, as functions of the frame k."""
import numpy as np

FRAMES = 4
N = 7
i = np.arange(N)
zero = np.zeros(N)


def position(k):
    return np.stack([i - 3.0 + 0.125 * k, 0.5 * i - 2, zero], axis=1)


def image(k):
    return np.stack([k - i, i, 0 * i], axis=1)


def angle(k):
    return 0.5 * i - 3.0 * k


def velocity(k):
    return np.stack([0.25 * i, zero - 0.5 * k, zero], axis=1)


def angular_velocity(k):
    return i + 0.125 * k


def edges(k):
    return np.diag([20.0 + k, 10.0, 1.0])


species = i % 2
mass = np.where(i % 2, 1.5, 1.0)
semiaxes = np.where((i % 2)[:, None], [1.0, 1.0, 0.0], [2.0, 0.5, 0.0])
