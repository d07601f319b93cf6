#pragma once

/// GLSL 3.30; linear colour, world coordinates.
namespace verp::render {

extern const char* const kSolidVertex;  ///< position, normal, texture coordinate
/// lit_header() leaves out unused parts: a software driver runs both sides of every `if` and looks
/// up what a loop indexes.
extern const char* const kLitFragment;
extern const char* const kShadowVertex;  ///< depth from the sun
extern const char* const kShadowFragment;
extern const char* const kSkyVertex;  ///< one triangle
extern const char* const kSkyFragment;
extern const char* const kMeasureFragment;  ///< with kSolidVertex: depth and label
extern const char* const kMarkVertex;       ///< position, normal, colour
extern const char* const kMarkFragment;

}  // namespace verp::render
