// ReplayDrivers.h - devices that replay files, on the virtual clock as well as the steady clock.
//
//   recording:PATH            replays a recording (core/acquisition) as a fingertip; it begins when it is opened.
//                             PATH is its folder, its JSON file, or an EDF, BDF or XDF file
//   recording:PATH?speed=2    plays it twice as fast and compresses its time stamps
//   capture:FOLDER            plays captures of any known format, in order of name, as an oscilloscope
//
// A replayed file is not marked as simulated, because its data were measured once.
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
