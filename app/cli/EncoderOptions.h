// EncoderOptions.h - what a board that encodes drives, and into which load: options of firmware-profile and sensor
// compare, so that both mean the same board.
#pragma once

#include <QCommandLineParser>

#include "core/devices/Device.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::cli {

/// Declares --load, --source, --largest, --step and --device.
void declareEncoderOptions(QCommandLineParser& parser);

/// Whether any of them is given.
[[nodiscard]] bool encoderOptionsGiven(const QCommandLineParser& parser);

struct EncoderBench {
    EncoderOutput output;
    std::vector<StreamInfo> streams;  ///< of the sensor of --device; empty: none was given
    std::string fingertip;            ///< its serial number
};

/// Asks the devices of --device, and closes them again. Ceilings are not set. Errors: InvalidArgument naming the
/// option; as Registry::open().
[[nodiscard]] Result<EncoderBench> encoderBench(const QCommandLineParser& parser);

}  // namespace tacto::cli
