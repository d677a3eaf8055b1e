"""The parameters of an autopilot that a companion depends on, and how it tells them."""

import struct

from pymavlink.dialects.v20 import common as mavlink

REAL32, INT32 = mavlink.MAV_PARAM_TYPE_REAL32, mavlink.MAV_PARAM_TYPE_INT32

# As a vehicle has them that flies by its own estimator: whole numbers are integers, the others are not.
USUAL = {
    "px4": {"COM_OF_LOSS_T": 1.0, "COM_OBL_RC_ACT": 5, "EKF2_EV_CTRL": 0, "EKF2_EV_DELAY": 0.0},
    "ardupilot": {"GUID_TIMEOUT": 3.0, "EK3_SRC1_POSXY": 3, "EK3_SRC1_VELXY": 3, "EK3_SRC1_POSZ": 1,
                  "EK3_SRC1_VELZ": 3, "EK3_SRC1_YAW": 1, "VISO_TYPE": 0},
}
LOSS = {"px4": "COM_OF_LOSS_T", "ardupilot": "GUID_TIMEOUT"}


class Parameters:
    def __init__(self, rules_name: str, loss_s: float, changed: dict[str, float]):
        """Raises ValueError naming a parameter that is not known."""
        self._bytewise = rules_name == "px4"
        self._values = dict(USUAL[rules_name])
        self._values[LOSS[rules_name]] = loss_s
        for name, value in changed.items():
            if name not in self._values:
                raise ValueError(f"{name}: the parameters are {', '.join(self._values)}")
            self._values[name] = type(self._values[name])(value)

    def answer(self, request, link: mavlink.MAVLink) -> None:
        """Tells what a PARAM_REQUEST_READ asks for by name; of an unknown one it says nothing."""
        name = request.param_id
        if name in self._values:
            index = list(self._values).index(name)
            link.param_value_send(name.encode(), *self._told(self._values[name]), len(self._values), index)

    def _told(self, value: int | float) -> tuple[float, int]:
        """As a float, and its type: PX4 tells the bytes of an integer, ArduPilot its value."""
        if isinstance(value, float):
            return value, REAL32
        return (struct.unpack("<f", struct.pack("<i", value))[0] if self._bytewise else float(value)), INT32
