// ReplayDrivers.h - devices made of files, for the virtual clock as well as the steady one.
//
//   recording:PATH            a recording (core/acquisition) replayed as a fingertip, first stamp = when it was opened
//   recording:PATH?speed=2    the same, played twice as fast; its stamps shrink with it
//   capture:FOLDER            captures of any format that is known, in the order of their names, as an oscilloscope
//
// A file is not simulated: what it holds was measured once.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "core/formats/CaptureFormats.h"

namespace tacto {

[[nodiscard]] std::unique_ptr<Driver> makeRecordingDriver();
[[nodiscard]] std::unique_ptr<Driver> makeCaptureDriver(
    std::shared_ptr<const CaptureFormats> formats = ownCaptureFormats());

}  // namespace tacto
