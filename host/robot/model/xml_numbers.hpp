#pragma once
#include <cstddef>
#include <string>

/// Numbers in the XML of SDF and URDF, read strictly and held within what the controller can
/// compute with. Each throws LoadError; what is not known as a number is not looked at.
namespace verp::model {

/// Of SDF; or of what a URDF tells Gazebo, where any number goes: mu1 is 9000 in good files.
void check_leaf(const std::string& file, int line, const std::string& element,
                const std::string& text, bool is_urdf);
void check_urdf_attribute(const std::string& file, int line, const std::string& element,
                          const std::string& attribute, const std::string& text);
/// One number of any size, or three of a position or size in metres.
void require_numbers(const std::string& file, int line, const std::string& what,
                     const std::string& text, std::size_t count);

}  // namespace verp::model
