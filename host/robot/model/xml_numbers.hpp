#pragma once
#include <cstddef>
#include <string>

/// Strict checks of numbers in SDF and URDF against the range that the controller can compute with.
/// Each throws LoadError and ignores elements that are not known as numbers.
namespace verp::model {

/// For SDF, or for a URDF's <gazebo>, where any number is allowed: mu1 is 9000 in good files.
void check_leaf(const std::string& file, int line, const std::string& element,
                const std::string& text, bool is_urdf);
void check_urdf_attribute(const std::string& file, int line, const std::string& element,
                          const std::string& attribute, const std::string& text);
/// One number of any size, or three for a position or size in metres.
void require_numbers(const std::string& file, int line, const std::string& what,
                     const std::string& text, std::size_t count);

}  // namespace verp::model
