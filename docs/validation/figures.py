"""The plots of the validation: one style, one folder."""

import matplotlib
from common import ROOT

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PLOTS = ROOT / "docs" / "plots"

plt.rcParams.update({"figure.dpi": 80, "font.size": 8.5, "axes.grid": True, "grid.alpha": 0.3, "legend.fontsize": 7.5})


def save(figure: plt.Figure, name: str) -> str:
    """Keeps a figure in docs/plots; what embeds it in docs/validation.md."""
    PLOTS.mkdir(exist_ok=True)
    figure.savefig(PLOTS / name, bbox_inches="tight")
    plt.close(figure)
    return f"![{name.removesuffix('.png').replace('_', ' ')}](plots/{name})\n"
