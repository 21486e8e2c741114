"""The manual: how Sphinx builds it from these pages. `make docs` writes it to out/manual."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))
# Cells run as for a new user, without the start-up files of whoever builds the manual.
PROFILE = ROOT / "build" / "manual" / "ipython" / "profile_default"
PROFILE.mkdir(parents=True, exist_ok=True)
os.environ["IPYTHONDIR"] = str(PROFILE.parent)
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(ROOT), os.getenv("PYTHONPATH")]))

from sphinx_gallery.sorting import ExplicitOrder  # noqa: E402

import rocksteady  # noqa: E402
from rocksteady.show.style.tokens import DARK, LIGHT  # noqa: E402
from tools.manual import cells, gallery, mathematics, page_explorer, theme  # noqa: E402

(PROFILE / "ipython_kernel_config.py").write_text(cells.CONFIGURATION, "utf-8")

project = "rocksteady"
author = "The rocksteady developers"
copyright = f"2026, {author}"  # noqa: A001
version = release = rocksteady.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "myst_nb",
    "tools.manual.pages",
    "tools.manual.twins",
    "tools.manual.reference",
    "tools.manual.docstrings",
    "tools.manual.commands",
    "tools.manual.page_explorer",
]
# What the gallery writes beside each of its pages.
exclude_patterns = [
    "sg_execution_times.rst",
    "gallery/**/sg_execution_times.rst",
    *(f"gallery/{folder}*.{ending}" for folder in ("", "**/") for ending in gallery.BESIDE),
]
nitpicky = True
# The checkout may lie in a folder whose name has a space: the links of the manual are relative.
suppress_warnings = ["sphinx_gallery.space_in_filename"]
templates_path = ["_templates"]

# ------------------------------------------------------------------------------------- Markdown

myst_enable_extensions = ["attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True

# Tutorials, how-tos and evidence are computed at each build. A cell that raises or warns is a
# warning of the build with its traceback, which ends it like any other.
nb_execution_mode = "auto"
nb_execution_show_tb = True
nb_output_stderr = "warn"
nb_execution_timeout = 240
nb_merge_streams = True
nb_code_prompt_show, nb_code_prompt_hide = "Show the code", "Hide the code"
nb_execution_in_temp = True

# ------------------------------------------------------------------------------------ docstrings

autodoc_typehints = "none"  # they stand in the lists of parameters: tools/manual/docstrings.py
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_default_options = {
    "members": True,
    "inherited-members": "Result, tuple, str, int, Enum, BaseException",
    "special-members": "__call__",
}
default_role = "name"
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False
napoleon_preprocess_types = False
napoleon_custom_sections = [("Attributes", "params_style")]
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"
add_module_names = False

# ---------------------------------------------------------------------------------------- gallery

gallery.remove_stale_pages(ROOT / "docs" / "gallery")
sphinx_gallery_conf = {
    "examples_dirs": ["../examples"],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r".*\.py",
    "within_subsection_order": "FileNameSortKey",
    "subsection_order": ExplicitOrder([*(f"../examples/{name}" for name in gallery.ORDER), "*"]),
    "nested_sections": True,
    "capture_repr": (),
    "write_computation_times": False,
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
    "remove_config_comments": True,
    "reset_modules": ("tools.manual.gallery.prepare",),
    "image_scrapers": ("tools.manual.gallery.save_pictures",),
    "thumbnail_size": (420, 294),
    "abort_on_example_error": True,
    "matplotlib_animations": False,
    "parallel": int(os.environ.get("WORKERS", "2")),
}

# ------------------------------------------------------------------------------------------- HTML

html_theme = "furo"
html_title = f"rocksteady {release}"
html_logo = html_favicon = "_static/logo.svg"
html_static_path = ["_static", *mathematics.static_path(), *page_explorer.static_path()]
html_css_files = ["manual.css", "gallery.css"]
html_theme_options = {
    "sidebar_hide_name": False,
    "top_of_page_buttons": [],
    "light_css_variables": theme.variables(LIGHT),
    "dark_css_variables": theme.variables(DARK),
}
pygments_style = "tools.manual.theme.LightCode"
pygments_dark_style = "tools.manual.theme.DarkCode"
html_show_sourcelink = False
html_copy_source = False
mathjax_path = mathematics.SCRIPT
mathjax3_config = {"svg": {"fontCache": "global"}, "options": {"enableMenu": True}}
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
