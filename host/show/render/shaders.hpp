#pragma once

/// GLSL 3.30. Lighting is in linear colour and world coordinates.
namespace verp::render {

extern const char* const kSolidVertex;  ///< position, normal, texture coordinate
/// lit_header() leaves out what a picture does not need: a software driver runs both sides of every
/// `if` and looks up what a loop indexes.
extern const char* const kLitFragment;
extern const char* const kShadowVertex;  ///< depth seen from the sun
extern const char* const kShadowFragment;
extern const char* const kSkyVertex;  ///< one triangle over the whole picture
extern const char* const kSkyFragment;
extern const char* const kMeasureFragment;  ///< with kSolidVertex: depth and label
extern const char* const kMarkVertex;       ///< position, normal, colour
extern const char* const kMarkFragment;

}  // namespace verp::render
