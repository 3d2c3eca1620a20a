"""The Motion panel: parameters that go in time, played in the picture with the contacts of each step."""
