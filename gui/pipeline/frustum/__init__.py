"""The frustum seen from outside: its page, what is painted, and the lens that can be tried."""
