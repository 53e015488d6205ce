// InstrumentPresets.h - the laboratory's own instruments by name: oscilloscopes, shunts and probes, saved once with the
// figures of their data sheet or certificate, and combined into the address of a device.
//
// A figure that is not stated is unknown, and so are all figures of an instrument with an expired certificate. Neither
// appears in an address (hazard H9). An oscilloscope's certificate takes priority over an address (ScopeStatement.h).
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
    std::string name;                    ///< chosen by the laboratory; unique within its kind
    std::string serial;                  ///< may be empty
    std::string address;                 ///< only for oscilloscopes: "sigrok:rigol-ds:conn=...?voltage=CH1&current=CH2"
    std::optional<double> ohms;          ///< only for shunts
    std::optional<double> accuracy_pct;  ///< half-width: gain of an oscilloscope, tolerance of a shunt or probe
    std::optional<double> timeBase_ppm;  ///< half-width; only for oscilloscopes
    std::optional<CalibrationDate> due;  ///< last day of its certificate; nothing: figures from a data sheet
    [[nodiscard]] bool expired(CalibrationDate today) const { return due && *due < today; }
};

/// Errors: InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<void> check(const InstrumentPreset& preset);

/// The chosen instruments of a bench; nothing for a kind that was not chosen.
struct ChosenInstruments {
    std::optional<InstrumentPreset> oscilloscope, shunt, probe;
};
struct ComposedAddress {
    std::string text;               ///< the oscilloscope's address with its figures; may be empty
    std::vector<std::string> said;  ///< sentences about unused or unknown figures and the consequences
};
[[nodiscard]] ComposedAddress composed(const ChosenInstruments& chosen, CalibrationDate today);

class InstrumentPresets {
public:
    /// Reads the file; a missing file means no presets. Errors: Io; ParseError naming the entry, the value and what is
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

/// Returns $XDG_DATA_HOME/tactoscope/instruments.json, next to calibrationFile().
[[nodiscard]] std::filesystem::path instrumentFile();

}  // namespace tacto
