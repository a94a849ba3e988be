"""A game as text, as a picture, and in a notebook."""

from testbed.environment.rendering.modes import MODES, draw_text, html_of, render
from testbed.environment.rendering.picture import Image, draw_picture
from testbed.environment.rendering.scene import Scene, scene

__all__ = ["MODES", "Image", "Scene", "draw_picture", "draw_text", "html_of", "render", "scene"]
