"""Names the derivatives that a graph has besides the functions: which are asked for, and as options of a command."""

from dataclasses import dataclass

PARAMETERS = ":parameters"
MATRICES = ("forward_dynamics", "impact")


class DerivativesError(Exception):
    """Derivatives of what is no function; one line that names it."""


@dataclass(frozen=True)
class Derivatives:
    """``matrices``: of which of MATRICES. ``directional``: names of functions, with `:parameters` where the direction
    has parameters, too."""

    matrices: tuple[str, ...] = ()
    directional: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if unknown := [name for name in self.matrices if name not in MATRICES]:
            raise DerivativesError(f"no derivatives of `{unknown[0]}`; there are: {', '.join(MATRICES)}")

    def options(self) -> list[str]:
        """As words of a command line."""
        words = []
        if self.matrices:
            named = [name for name in MATRICES if name in self.matrices]
            words.append("--derivatives" + ("" if len(named) == len(MATRICES) else f"={','.join(named)}"))
        return [*words, "--directional", ",".join(self.directional)] if self.directional else words


NO_DERIVATIVES = Derivatives()
