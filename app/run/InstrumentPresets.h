// InstrumentPresets.h - the laboratory's own instruments by name: oscilloscopes, shunts and probes, saved once with
// what their data sheet or certificate states, and put together as the address of a device.
//
// A figure that is not stated is unknown, and so is each figure of an instrument whose certificate expired: neither
// gets into an address (hazard H9). A certificate of the oscilloscope comes before what an address says
// (ScopeStatement.h).
//
//   {"instruments": [{"kind": "shunt", "name": "R100", "ohms": 100, "accuracy_pct": 0.1, "due": "2027-03-01"}]}
//
// Thread-safety: values; reading and writing from any thread, the last writer wins.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Words.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

enum class InstrumentKind { Oscilloscope, Shunt, Probe };
inline constexpr Word<InstrumentKind> kInstrumentKinds[] = {
    {"oscilloscope", InstrumentKind::Oscilloscope}, {"shunt", InstrumentKind::Shunt}, {"probe", InstrumentKind::Probe}};
[[nodiscard]] constexpr std::string_view nameOf(InstrumentKind kind) noexcept {
    return wordFor(kInstrumentKinds, kind);
}

struct InstrumentPreset {
    InstrumentKind kind = InstrumentKind::Oscilloscope;
    std::string name;            ///< the laboratory's; one of its kind
    std::string serial;          ///< may be empty
    std::string address;         ///< an oscilloscope's alone: "sigrok:rigol-ds:conn=...?voltage=CH1&current=CH2"
    std::optional<double> ohms;  ///< a shunt's alone
    std::optional<double> accuracy_pct;  ///< half-width: an oscilloscope's gain, a shunt's or probe's tolerance
    std::optional<double> timeBase_ppm;  ///< half-width; an oscilloscope's alone
    std::optional<CalibrationDate> due;  ///< last day of its certificate; nothing: the data sheet's figures
    [[nodiscard]] bool expired(CalibrationDate today) const { return due && *due < today; }
};

/// Errors: InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<void> check(const InstrumentPreset& preset);

/// The chosen instruments of a bench. Nothing for a kind without a choice.
struct ChosenInstruments {
    std::optional<InstrumentPreset> oscilloscope, shunt, probe;
};
struct ComposedAddress {
    std::string text;               ///< the oscilloscope's address, with what is stated; empty without one
    std::vector<std::string> said;  ///< sentences on what is unused or unknown, and what that leaves unknown
};
[[nodiscard]] ComposedAddress composed(const ChosenInstruments& chosen, CalibrationDate today);

class InstrumentPresets {
public:
    /// Reads the file; one that is not there is empty. Errors: Io; ParseError naming the entry, the value and what is
    /// accepted.
    [[nodiscard]] static Result<InstrumentPresets> open(std::filesystem::path file);
    [[nodiscard]] const std::vector<InstrumentPreset>& all() const noexcept { return all_; }
    /// Replaces a preset with the same kind and name. Errors: as check(); Io.
    [[nodiscard]] Result<void> save(const InstrumentPreset& preset);
    /// Errors: NotFound; Io.
    [[nodiscard]] Result<void> remove(InstrumentKind kind, std::string_view name);

private:
    explicit InstrumentPresets(std::filesystem::path file) : file_(std::move(file)) {}
    [[nodiscard]] Result<void> write(std::vector<InstrumentPreset> all);

    std::filesystem::path file_;
    std::vector<InstrumentPreset> all_;
};

/// Beside calibrationFile(): $XDG_DATA_HOME/tactoscope/instruments.json.
[[nodiscard]] std::filesystem::path instrumentFile();

}  // namespace tacto
