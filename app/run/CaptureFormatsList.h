// CaptureFormatsList.h - all capture formats that the programs read and write, listed in this one place.
//
// Thread-safety: any thread.
#pragma once

#include <memory>

#include "core/formats/CaptureFormats.h"

namespace tacto {

[[nodiscard]] std::shared_ptr<const CaptureFormats> captureFormats();

}  // namespace tacto
