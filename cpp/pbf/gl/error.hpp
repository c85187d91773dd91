#pragma once

namespace pbf {

/// Throws std::bad_alloc or GlError if the driver reports that a call has failed; what it had to
/// report is forgotten then.
void require_no_gl_error();

}  // namespace pbf
