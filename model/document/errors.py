"""The one exception that carries words for the user."""


class Refusal(Exception):
    """Says in one line what is wrong, where, and what to do; whoever raises it has changed nothing."""
