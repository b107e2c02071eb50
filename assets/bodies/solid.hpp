#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "bodies/field.hpp"

namespace elastolab::bodies {

/// A body: what is inside all of its sheets, each of which is smooth. Where two of them meet the body has a sharp edge.
struct Solid {
    std::string name;
    std::vector<Field> sheets;                                  ///< at most 31
    Eigen::AlignedBox3d box;                                    ///< contains the body
    std::function<double(const Eigen::Vector3d&)> edge_length;  ///< wanted there [L]
    double cell = 0.05;                                         ///< of the grid it is first found on [L]
};

/// A ball around which edges are shorter.
struct FineSpot {
    Eigen::Vector3d center;
    double radius, edge_length;
};
/// `coarse`, but at most the length of each spot inside it, growing by a fifth of the distance from it.
std::function<double(const Eigen::Vector3d&)> sizing(double coarse, const std::vector<FineSpot>& spots = {});

// The bodies, 1 to 4 units long, z upward. Each function says nothing but the shape.

Solid make_liver();     ///< two lobes with a notch between them, hollow below
Solid make_heart();     ///< ventricles, atria, the arch of the aorta and two stumps of vessels
Solid make_hand();      ///< palm, five fingers, cut off at the wrist
Solid make_rabbit();    ///< sits; thin ears
Solid make_dog_bone();  ///< flat tensile specimen
Solid make_ring();      ///< of square section, split
Solid make_bracket();   ///< L with a fillet, two bolt holes in the wall leg and one in the arm

std::vector<Solid> all_bodies();

}  // namespace elastolab::bodies
