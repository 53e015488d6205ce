// CertificateStore.h - the calibration certificates of a lab's oscilloscopes: one file, a line per certificate or
// withdrawal; no line is overwritten.
//
// The lines are chained (ChainedLines.h). For each serial number, the certificate with the latest date is in use, from
// that date until its due date; once expired it is shown but not used, and an older one does not replace it. A
// certificate that was entered wrongly is withdrawn: the previous certificate is then in use again.
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

// A calibration certificate of an oscilloscope, as the user copies it from paper: science.md section 12.
//
// The uncertainties are the certificate's expanded ones, k = 2 (GUM 6.2). An uncertainty that the certificate does not
// state is absent, never 0 (hazard H9). The user enters all values: the program cannot check the paper.

struct Certificate {
    std::string instrument;  ///< maker and model; not empty
    std::string serial;      ///< the instrument's serial number; never empty, so that two of a kind differ
    std::string number;      ///< the certificate's number; not empty
    std::string by;          ///< name of the laboratory; not empty
    CalibrationDate date{};
    CalibrationDate due{};  ///< the last day on which the certificate is used; not before `date`
    /// U of the vertical gain, in % of the reading; also applies to currents, read through the same input. Required.
    std::optional<double> gain_pct;
    std::optional<double> timeBase_ppm;
    std::optional<double> shunt_pct;
    std::optional<double> probe_pct;
    bool operator==(const Certificate&) const = default;
};

/// A text of the certificate; files and options call it `key`, people call it `title`.
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
    const char* option;  ///< the option on the command line
    std::string_view title;
    std::string_view unit;
    double perUnit;  ///< factor from `unit` to a relative value
    double most;     ///< largest value, in `unit`
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

/// Returns the certificate's statements, each as a half-width a with 95 % of it within U: a = U/0.95, never less than
/// stated (a rectangle of the same standard uncertainty would be). Each figure names its certificate.
[[nodiscard]] InstrumentStatement statementOf(const Certificate& certificate);
/// Example: "certificate 4711 (DKD Lab, 2026-01-05, due 2027-01-05)".
[[nodiscard]] std::string certificateText(const Certificate& certificate);
/// Example: "U (k = 2): voltage gain 0.5 %, time base 2 ppm; shunt, probe not stated".
[[nodiscard]] std::string figuresText(const Certificate& certificate);

/// Writes absent uncertainties as null.
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
    /// Reads the file; a missing file is an empty store. Errors: Io; ParseError naming the line that is not valid.
    [[nodiscard]] static Result<CertificateStore> open(std::filesystem::path file);

    /// Errors: InvalidArgument as check(), or for a number that this serial already has; Io; ParseError if the file was
    /// damaged meanwhile.
    [[nodiscard]] Result<void> add(const Certificate& certificate, CalibrationDate today);
    /// `serial` may be empty if only one instrument has a certificate of that number. Errors: NotFound for a number not
    /// entered or withdrawn; InvalidArgument naming the serials with that number; as add().
    [[nodiscard]] Result<void> withdraw(std::string_view number, std::string_view serial, CalibrationDate today);

    /// Returns the state of all()[`index`] on `day`.
    [[nodiscard]] CertificateState state(std::size_t index, CalibrationDate day) const;
    /// Returns the newest certificate of that serial that is not withdrawn and not dated after `day`; if there is none,
    /// the first that begins later. Index into all().
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

/// In the folder of calibrationFile(): $XDG_DATA_HOME/tactoscope/certificates.jsonl.
[[nodiscard]] std::filesystem::path certificateFile();

}  // namespace tacto
