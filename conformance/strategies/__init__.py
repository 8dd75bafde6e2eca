"""Hypothesis strategies for queries that are worth asking.

Numbers drawn at random almost never touch anything. So a query is *aimed*: a polygon is chosen, a point on
it, a distance from it around the radius of a sphere, and the mover, its movement and the pose of the scene
are built from there. What is drawn is small whole numbers and choices, so that a failing query shrinks to a
readable one.

Strategies are made once, as constants; what depends on drawn values is a function ``draw_...(draw, ...)``,
because making a strategy costs Hypothesis far more than drawing from it.
"""
