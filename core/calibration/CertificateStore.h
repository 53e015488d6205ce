// CertificateStore.h - the calibration certificates of a lab's oscilloscopes: one file, a line per certificate or
// withdrawal, never overwritten.
//
// The lines are chained (ChainedLines.h). The certificate with the latest date counts for its serial number, from
// that date until its due date; an expired one is shown and not used, and does not bring back an older one. A
// certificate that was entered wrongly is withdrawn: the one before it counts again.
//
// Thread-safety: none; one owner. add() and withdraw() lock the file against other processes.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/ChainedLines.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

// A calibration certificate of an oscilloscope, as the user copies it from the paper: science.md
// section 12.
//
// Uncertainties are the expanded ones of the certificate, k = 2 (GUM 6.2). One that the certificate does not state is
// absent, never 0 (hazard H9). The user enters all of it: the program cannot see the paper.

struct Certificate {
    std::string instrument;  ///< maker and model; not empty
    std::string serial;      ///< the instrument's; never empty, so that two of a kind are told apart
    std::string number;      ///< the certificate's; not empty
    std::string by;          ///< the laboratory; not empty
    CalibrationDate date{};
    CalibrationDate due{};  ///< the last day on which it counts; not before `date`
    /// U of the vertical gain, in % of the reading: a current is read through the same input. Always there.
    std::optional<double> gain_pct;
    std::optional<double> timeBase_ppm;
    std::optional<double> shunt_pct;
    std::optional<double> probe_pct;
    bool operator==(const Certificate&) const = default;
};

/// The texts and uncertainties by what files, options and people call them.
struct CertificateText {
    std::string_view key;
    std::string_view title;
    std::string Certificate::*member;
};
inline constexpr std::array<CertificateText, 4> kCertificateTexts{
    {{"instrument", "instrument", &Certificate::instrument},
     {"serial", "serial number", &Certificate::serial},
     {"number", "certificate number", &Certificate::number},
     {"by", "laboratory", &Certificate::by}}};
struct CertificateFigure {
    std::string_view key;
    const char* option;  ///< its option on the command line
    std::string_view title;
    std::string_view unit;
    double perUnit;  ///< relative
    double most;     ///< in `unit`
    bool required;
    std::optional<double> Certificate::*member;
};
inline constexpr std::array<CertificateFigure, 4> kCertificateFigures{
    {{"gain_u_pct", "gain-u", "voltage gain", "%", 1e-2, 50, true, &Certificate::gain_pct},
     {"timebase_u_ppm", "timebase-u-ppm", "time base", "ppm", 1e-6, 1e5, false, &Certificate::timeBase_ppm},
     {"shunt_u_pct", "shunt-u", "shunt", "%", 1e-2, 50, false, &Certificate::shunt_pct},
     {"probe_u_pct", "probe-u", "probe", "%", 1e-2, 50, false, &Certificate::probe_pct}}};

/// Errors: InvalidArgument naming the value and what is accepted: a text that is empty, too long or not printable,
/// dates that do not exist or a due date before the date, a U that is missing, not above 0 or above `most`.
[[nodiscard]] Result<void> check(const Certificate& certificate);

/// Its statements, each as the half-width whose 95 % are the certificate's U: a = U/0.95, which is never less than what
/// it states (a rectangle of the same standard uncertainty would be). Each figure names its certificate.
[[nodiscard]] InstrumentStatement statementOf(const Certificate& certificate);
/// "certificate 4711 (DKD Lab, 2026-01-05, due 2027-01-05)".
[[nodiscard]] std::string certificateText(const Certificate& certificate);
/// "U (k = 2): voltage gain 0.5 %, time base 2 ppm; shunt, probe not stated".
[[nodiscard]] std::string figuresText(const Certificate& certificate);

/// Absent uncertainties are null.
[[nodiscard]] nlohmann::json toJson(const Certificate& certificate);
/// Errors: ParseError naming the key; as check().
[[nodiscard]] Result<Certificate> certificateFrom(const nlohmann::json& json);

enum class CertificateState { Counts, Superseded, Expired, NotYet, Withdrawn };
/// "in use", "superseded", "expired", "dated in the future", "withdrawn".
[[nodiscard]] std::string_view nameOf(CertificateState state) noexcept;

struct EnteredCertificate {
    Certificate certificate;
    CalibrationDate entered{};
    std::optional<CalibrationDate> withdrawn{};
};

class CertificateStore {
public:
    /// Reads the file; one that is not there is empty. Errors: Io; ParseError naming the line that does not check.
    [[nodiscard]] static Result<CertificateStore> open(std::filesystem::path file);

    /// Errors: InvalidArgument as check(), or for a number that stands for this serial already; Io; ParseError when the
    /// file was damaged meanwhile.
    [[nodiscard]] Result<void> add(const Certificate& certificate, CalibrationDate today);
    /// `serial` may be empty where one instrument alone has a certificate of that number. Errors: NotFound for a number
    /// that is not entered, or withdrawn; InvalidArgument naming the serials it stands for; as add().
    [[nodiscard]] Result<void> withdraw(std::string_view number, std::string_view serial, CalibrationDate today);

    /// The standing of all()[`index`] on `day`.
    [[nodiscard]] CertificateState state(std::size_t index, CalibrationDate day) const;
    /// The newest of that serial that is not withdrawn and not dated after `day`; without one, the first that begins
    /// after it. Index into all().
    [[nodiscard]] std::optional<std::size_t> newest(std::string_view serial, CalibrationDate day) const;

    [[nodiscard]] const std::vector<EnteredCertificate>& all() const noexcept { return all_; }
    [[nodiscard]] bool lastLineCut() const noexcept { return lines_.lastLineCut(); }

private:
    explicit CertificateStore(std::filesystem::path file) : lines_(std::move(file), "certificate") {}
    [[nodiscard]] Result<void> read();
    [[nodiscard]] Result<void> take(const nlohmann::json& line);
    [[nodiscard]] Result<EnteredCertificate*> standing(std::string_view number, std::string_view serial);

    ChainedLines lines_;
    std::vector<EnteredCertificate> all_;
};

/// Beside calibrationFile(): $XDG_DATA_HOME/tactoscope/certificates.jsonl.
[[nodiscard]] std::filesystem::path certificateFile();

}  // namespace tacto
