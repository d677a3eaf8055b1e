"""The quadrature against a closed form and against numbers drawn."""

import unittest
from math import erfc, exp, pi, sqrt

import numpy as np
from tail import tail


class Tail(unittest.TestCase):
    def test_isotropic_equals_closed_form(self):
        for radius in (0.1, 1.0, 2.5, 4.0, 6.0):
            expected = erfc(radius / sqrt(2)) + sqrt(2 / pi) * radius * exp(-radius**2 / 2)
            self.assertAlmostEqual(tail(0.09 * np.eye(3), 0.3 * radius) / expected, 1, delta=1e-9)

    def test_general_agrees_with_monte_carlo(self):
        random = np.random.default_rng(1)
        for _ in range(4):
            half = random.normal(size=(3, 3)) * [0.1, 0.3, 1.0]
            covariance = half @ half.T
            lengths = np.linalg.norm(random.normal(size=(1_000_000, 3)) @ half.T, axis=1)
            radius = float(np.quantile(lengths, 0.99))
            self.assertAlmostEqual(tail(covariance, radius), 0.01, delta=5 * sqrt(0.01 / len(lengths)))

    def test_no_radius_is_certain_and_far_away_is_impossible(self):
        self.assertEqual(tail(np.eye(3), 0.0), 1.0)
        self.assertEqual(tail(np.eye(3), 10.0), 0.0)


if __name__ == "__main__":
    unittest.main()
