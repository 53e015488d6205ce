// SignalFile.h - what a file holds that names its own channels, units and times: EDF, BDF, XDF.
//
// The readers of these formats (core/exchange) make it; Recording takes a fingertip's streams from it.
//
// Thread-safety: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

struct SignalChannel {
    std::string label = {};  ///< may be empty or repeated
    std::string unit = {};   ///< as written
    std::size_t number = 1;  ///< from 1: in its stream (XDF), or among the file's signals (EDF, BDF)
};

/// Channels with common stamps: a stream of an XDF file, or all signals of one rate in an EDF or BDF file.
struct SignalStream {
    std::string name = {};                     ///< empty in EDF and BDF
    std::string type = {};                     ///< XDF: the content type, such as "EEG"
    std::optional<std::uint32_t> id = {};      ///< XDF: the stream's number in its file
    std::string serial = {};                   ///< of the device, where the file says it
    double rate_hz = 0;                        ///< as declared; 0 where the file declares none
    bool texts = false;                        ///< holds texts, which are counted and not kept
    std::size_t count = 0;                     ///< number of samples, of texts too
    std::size_t width = 0;                     ///< number of channels
    std::vector<SignalChannel> channels = {};  ///< those that the file describes, the first ones
    SampleBlock samples = {};                  ///< values as in the file, in its units
    std::string obstacle = {};                 ///< why its samples cannot be used; empty: they can
};

struct SignalFile {
    bool ours = false;                   ///< written by this program
    std::optional<bool> simulated = {};  ///< where the file says it
    std::vector<SignalStream> streams = {};
    std::vector<std::string> warnings = {};  ///< what could not be read, one sentence each
};

/// Reads such a file; nothing if `path` is none. Errors: as the formats' readers.
using SignalReader = std::function<Result<std::optional<SignalFile>>(const std::filesystem::path& path)>;

}  // namespace tacto
