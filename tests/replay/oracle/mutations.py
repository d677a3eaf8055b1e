"""Faults put into right answers, to prove that the comparison sees each kind."""

import copy

from nanomap_log import Status

# Name -> the fields that it changes, from the right answer. All need an answer with a view and a neighbour.
MUTATIONS = {
    "another status": lambda a: {"status": (a.status + 1) % Status.EMPTY},
    "another view": lambda a: {"view_index": a.view_index + 1},
    "another view's stamp": lambda a: {"view_utime": a.view_utime + 1},
    "no view": lambda a: {"has_view": False},
    "mean off by 1e-7 m": lambda a: {"mean_camera": [a.mean_camera[0] + 1e-7, *a.mean_camera[1:]]},
    "covariance off by a millionth": lambda a: {"covariance_camera": [c * (1 + 1e-6) for c in a.covariance_camera]},
    "distance off by 1 mm": lambda a: {"distances": [a.distances[0] + 1e-3, *a.distances[1:]]},
    "another neighbour": lambda a: {"neighbours": [[c + 1e-3 for c in a.neighbours[0]], *a.neighbours[1:]]},
    "a neighbour less": lambda a: {"num_neighbours": a.num_neighbours - 1, "neighbours": a.neighbours[:-1],
                                   "distances": a.distances[:-1]},
}


def mutants(message):
    """Pairs of a fault's name and the message with that fault in its only answer; none if no answer can carry them."""
    whole = next((a for a in message.answers if a.num_neighbours > 0 and any(a.covariance_camera)), None)
    if whole is None:
        return
    for name, change in MUTATIONS.items():
        mutant = copy.copy(message)
        answer = copy.copy(whole)
        for field, value in change(whole).items():
            setattr(answer, field, value)
        mutant.answers = [answer]
        yield name, mutant
