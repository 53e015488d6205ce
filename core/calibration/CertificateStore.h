// CertificateStore.h - the calibration certificates of a lab's oscilloscopes: one file, a line per certificate or
// withdrawal, never overwritten.
//
// The lines are chained (ChainedLines.h). The certificate with the latest date counts for its serial number, from
// that date until its due date; an expired one is shown and not used, and does not bring back an older one. A
// certificate that was entered wrongly is withdrawn: the one before it counts again.
//
// Thread-safety: none; one owner. add() and withdraw() lock the file against other processes.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/calibration/Certificate.h"
#include "core/calibration/ChainedLines.h"

namespace tacto {

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

    /// How all()[`index`] stands on `day`.
    [[nodiscard]] CertificateState state(std::size_t index, CalibrationDate day) const;
    /// The newest of that serial that is not withdrawn and not dated after `day`; where there is none, the first that
    /// begins after it. Index into all().
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
