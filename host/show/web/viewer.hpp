#pragma once

namespace verp::web {

extern const char* const kViewerScript;  ///< viewer.js

}  // namespace verp::web
