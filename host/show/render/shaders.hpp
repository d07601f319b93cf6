#pragma once

/// GLSL 3.30. Lights are worked out in linear colour, in world coordinates.
namespace verp::render {

extern const char* const kSolidVertex;  ///< position, normal, texture coordinate
/// What things look like, behind a header of lit_header(): a software driver runs both sides of
/// every `if`, and looks up what a loop indexes, so what a picture does not need is left out.
extern const char* const kLitFragment;
extern const char* const kShadowVertex;  ///< depth seen from the sun
extern const char* const kShadowFragment;
extern const char* const kSkyVertex;  ///< one triangle over the whole picture
extern const char* const kSkyFragment;
extern const char* const kMeasureFragment;  ///< with kSolidVertex: depth and label
extern const char* const kMarkVertex;       ///< position, normal, colour
extern const char* const kMarkFragment;

}  // namespace verp::render
