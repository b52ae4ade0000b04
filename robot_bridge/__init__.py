"""The Robot protocol and its drivers: ideal table, PyBullet, Dobot."""
