"""Echoed lines of Python done again, as the console does them."""

from solidtree.model import script
from solidtree.model.operations.operations import OPERATIONS


def replayed(lines, start):
    """The document that the lines of a log make of another one."""
    document = start
    names = {name: getattr(script, name) for name in script.__all__}

    def bound(operation):
        def run(*arguments, **keywords):
            nonlocal document
            document = operation(document, *arguments, **keywords)

        return run

    names |= {name: bound(operation) for name, operation in OPERATIONS.items()}
    for line in lines:
        exec(line, names)
    return document
