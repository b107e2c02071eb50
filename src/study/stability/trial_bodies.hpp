#pragma once

#include "study/error/problems.hpp"

/// The bodies of trial_groups(), with their exact solutions: what is done to each grows with its parameter. Lengths are
/// of the order of 1, Young's modulus is 1 and Poisson's ratio 0.3 unless said otherwise; ends are the faces across x.
namespace elastolab::trial {

/// A bar of 2 x 1 x 1 in pure bending, its ends prescribed.
Problem bending_bar(double poisson_ratio);
/// Bent; one cell through the thickness, as thin bodies are usually meshed. Over the length.
Problem plate(double thickness);
/// Bent; one cell across. Over the length.
Problem needle(double thickness);
/// Bent; the cells stay as they are and the bar grows. Over the width.
Problem long_bar(double length);
/// Vertices inside the faces of a stretched cube pushed against a neighbour until triangles have this altitude, over
/// their edge.
Problem slivers(double altitude);
/// The bent bar, its inner vertices moved at random by up to so many cells within its faces.
Problem irregular(double jitter);
/// The cells at three faces are halved again and again towards those faces; the largest cells stay as they are.
Problem graded(double halvings);
/// The bending bar so many times as large.
Problem scaled(double scale);
/// The bending bar this far from the origin. The truth is that of the vertices as they are after rounding to doubles.
Problem far_away(double distance);
/// A constrained vertex inside a face of a cube and its neighbour at this distance, both prescribed.
Problem close_handles(double distance);
/// A cube held by three of its vertices, the third at this distance from the line through the others, and turned.
Problem barely_held(double distance);
/// This many vertices at a corner of a cube, held and turned: one, two, or three on a line do not hold it.
Problem few_held(double n);
/// The bending bar, both ends and at random this share of all vertices prescribed.
Problem share(double part);
/// Two cubes, each stretched between its ends, with this gap over their size; below zero they overlap.
Problem two_bodies(double gap);
/// A ball of this radius in the hollow of another, each moved its own way: two bodies, one inside the other. Near 1/2
/// they cross; beyond, the ball is inside the wall, which makes other solids of the same surfaces.
Problem nested(double radius);
/// The bending bar with displacements so many times as large.
Problem large_values(double factor);
/// The bending bar with this Young's modulus.
Problem stiff(double young_modulus);
/// A bar that hangs under so many times its weight.
Problem weight(double factor);
/// A hollow sphere under inner pressure whose wall is this thick, over its radius. Inside and outside have the same
/// cells, so that those of a thin wall are wide.
Problem pressed_wall(double thickness);

}  // namespace elastolab::trial
