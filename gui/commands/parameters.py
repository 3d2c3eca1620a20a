"""The window's commands on the parameters and their saved sets. They take the MainWindow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ...model.document.document import ParameterSet
from ...model.document.errors import Refusal
from ...model.editing.commands import Command
from ...model.operations.parameter_sets import fitting_sets

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "Edit/Parameters"


def _no_parameters(window: MainWindow) -> str | None:
    return None if window.session.document.parameters else "the document has no parameters"


def _no_sets(window: MainWindow) -> str | None:
    return None if window.session.document.sets else "no set of parameter values is saved"


def _no_chosen_set(window: MainWindow) -> str | None:
    return _no_sets(window) or (None if window.parameters.sets.chosen else "choose a set in the Parameters panel first")


def show_panel(window: MainWindow) -> None:
    """Bring the panel to the front, with the focus in it."""
    dock = window.docks["Parameters"]
    dock.show()
    dock.raise_()
    parameters = window.session.document.parameters
    if parameters:
        window.parameters.show_parameter(parameters[0].name)
    else:
        window.parameters.add.setFocus()


def show_parameter(window: MainWindow, name: str) -> None:
    """Bring one parameter's row to the front."""
    window.docks["Parameters"].show()
    window.docks["Parameters"].raise_()
    window.parameters.show_parameter(name)


def _add(window: MainWindow) -> None:
    window.docks["Parameters"].show()
    window.docks["Parameters"].raise_()
    window.parameters.add_parameter()


def ask_import(window: MainWindow) -> None:
    from .. import dialogs

    dialogs.ask_sets_path(window, Path(window.settings.folder), False, lambda path: import_sets(window, path))


def import_sets(window: MainWindow, path: str) -> None:
    """Add the sets in a file, as one step; what the document has no parameter for is left out, and told."""

    def work() -> tuple[ParameterSet, ...]:
        from ...model.exchange.set_files import read_sets

        return read_sets(path)

    def done(found: tuple[ParameterSet, ...]) -> None:
        sets, left_out = fitting_sets(window.session.document, found)
        try:
            if not sets:
                raise Refusal("none of its values is for a parameter of this document")
            rows = tuple((one.name, one.values) for one in sets)
            window.session.do("put_sets", rows, label=f"Import {Path(path).name}")
        except Refusal as refusal:
            refused(refusal)
            return
        words = f"Imported {len(sets)} set{'s' if len(sets) != 1 else ''}"
        window.status.say(f"{words}; left out: {', '.join(left_out)}" if left_out else words)

    def refused(refusal: Refusal) -> None:
        from .. import dialogs

        dialogs.tell(window, f"{Path(path).name} could not be imported", str(refusal))

    window.files.background.run(f"Reading {Path(path).name}", work, done, refused)


def ask_export(window: MainWindow) -> None:
    from .. import dialogs

    start = Path(window.settings.folder, window.files.name + ".json")
    dialogs.ask_sets_path(window, start, True, lambda path: export_sets(window, path))


def export_sets(window: MainWindow, path: str) -> None:
    """Write the saved sets to a file."""
    sets = window.session.document.sets

    def work() -> None:
        from ...model.exchange.set_files import write_sets

        write_sets(path, sets)

    def refused(refusal: Refusal) -> None:
        from .. import dialogs

        dialogs.tell(window, f"{Path(path).name} could not be written", str(refusal))

    window.files.background.run(
        f"Writing {Path(path).name}", work, lambda _: window.status.say(f"Exported {Path(path).name}"), refused
    )


PARAMETER_COMMANDS: tuple[Command, ...] = (
    Command("parameters", "Parameters", MENU, show_panel, shortcut="Ctrl+Shift+P", icon="parameters",
            tip="The panel in which named numbers are turned"),
    Command("add_parameter", "Add a parameter", MENU, _add, icon="parameter",
            tip="A number with a name, for use in any number field"),
    Command("save_set", "Save values as a set …", MENU, lambda w: w.parameters.sets.save_new(), _no_parameters,
            icon="save", tip="Keep the values that the parameters have now under a name"),
    Command("update_set", "Update the chosen set", MENU, lambda w: w.parameters.sets.save_again(), _no_chosen_set,
            icon="save", tip="Keep the values under the name of the set that was chosen last"),
    Command("reset_parameters", "Reset all values", MENU, lambda w: w.parameters.sets.reset_all(), _no_parameters,
            icon="reset", tip="Back to the values of the chosen set, or to those in the file"),
    Command("import_sets", "Import sets …", MENU, ask_import, _no_parameters, icon="import",
            tip="Sets of values from OpenSCAD's customizer (.json), or a table (.csv)"),
    Command("export_sets", "Export sets …", MENU, ask_export, _no_sets, icon="export",
            tip="Write the saved sets for OpenSCAD's customizer (.json), or as a table (.csv)"),
)  # fmt: skip
