"""How near surfaces come to each other and to points: distances with their points, inside and outside, clearances."""
