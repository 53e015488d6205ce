// CaptureFormatsList.h - every format of captures that the programs read and write, in the one place that names them.
//
// Thread-safety: any thread.
#pragma once

#include <memory>

#include "core/formats/CaptureFormats.h"

namespace tacto {

[[nodiscard]] std::shared_ptr<const CaptureFormats> captureFormats();

}  // namespace tacto
