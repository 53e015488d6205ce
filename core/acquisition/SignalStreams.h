// SignalStreams.h - takes a fingertip's streams from a file that names its own channels (SignalFile.h).
//
// Thread-safety: pure functions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/acquisition/RecordingDraft.h"
#include "core/acquisition/RecordingTable.h"
#include "core/acquisition/SignalFile.h"

namespace tacto {

/// What an entry of recording.json says of a stream in such a file.
struct SignalChoice {
    StreamKind kind = StreamKind::Acceleration;
    std::optional<ColumnChoice> stream = {};  ///< its name, or its number in the file; needed where there are several
    std::vector<ColumnChoice> columns = {};
    std::string unit = {};  ///< needed where the file states none that fits
};

struct ChosenSignals {
    StreamUnit unit = StreamUnit::Count;
    SampleBlock samples = {};
    std::string name = {};    ///< of the stream; may be empty
    std::string serial = {};  ///< of the device, where the file says it
};

/// Returns the chosen channels in SI units or counts. Errors: ParseError, one sentence without the file's name.
[[nodiscard]] Result<ChosenSignals> chooseSignals(const SignalFile& file, const SignalChoice& choice);

/// Returns a choice for each kind whose channels the file names as our exports do: "force", "acceleration_x",
/// "taxels_c1", with a unit. Samples without any value are gaps there.
[[nodiscard]] std::vector<SignalChoice> ownSignals(const SignalFile& file);
void dropEmptySamples(SampleBlock& samples, std::size_t channels);

/// Lists what the file holds: "x.xdf holds \"Fingertip\" (Force): Fz [mN], 800 samples at 100 Hz; ...".
[[nodiscard]] std::string signalList(const SignalFile& file, const std::filesystem::path& path);
/// Errors: ParseError if nothing in it can be of a fingertip, with the list.
[[nodiscard]] Result<RecordingDraft> draftSignals(const SignalFile& file, const std::filesystem::path& path);

}  // namespace tacto
