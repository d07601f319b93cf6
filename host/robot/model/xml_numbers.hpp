#pragma once
#include <cstddef>
#include <string>

/// Strict checks of SDF's and URDF's numbers, within the controller's range. Each throws LoadError
/// and ignores unknown elements.
namespace verp::model {

/// SDF, or a URDF's <gazebo>, where any number is allowed: mu1 is 9000 in good files.
void check_leaf(const std::string& file, int line, const std::string& element,
                const std::string& text, bool is_urdf);
void check_urdf_attribute(const std::string& file, int line, const std::string& element,
                          const std::string& attribute, const std::string& text);
/// One number, or three for a position or size, of any magnitude.
void require_numbers(const std::string& file, int line, const std::string& what,
                     const std::string& text, std::size_t count);

}  // namespace verp::model
