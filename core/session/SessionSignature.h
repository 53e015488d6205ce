// SessionSignature.h - who signed a report of a session, kept in the session itself.
//
// A signature is a row of its own behind the end mark, as changed labels are (SessionLabels.h), with the name, the time
// and the report's SHA-256, so that a report that is changed afterwards is noticed. It says who the program was told
// has signed; a signature by hand or in the PDF is not read.
//
// In a sealed session the row is not sealed either, since whoever verifies it without a key must see it: it holds no
// word of the participant, and of the report's place only a name that is the session's own.
//
//   {"wall": "2026-11-20T14:03:05Z", "signed": {"by": "A. Lind", "report": "run.pdf", "sha256": "64 digits"}}
//
// Thread-safety: any thread and several programs, as saveLabels().
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct SessionSignature {
    std::string by;
    std::string wall;    ///< ISO 8601 UTC
    std::string report;  ///< the file's name beside the session, or its whole path elsewhere; may be empty if sealed
    std::string sha256;  ///< of the report as it was signed, 64 hexadecimal digits
    bool operator==(const SessionSignature&) const = default;
};

/// Adds a signature of `report` as it is now. Blocks while the session is copied. Errors: InvalidArgument for a name
/// that is empty or longer than kLabelLimit; NotFound or Io if the report cannot be read; as annotateSession()
/// otherwise.
[[nodiscard]] Result<SessionSignature> signReport(const std::filesystem::path& session,
                                                  const std::filesystem::path& report, const std::string& by);

/// Returns the signatures in the order of signing. Errors: as SessionReader.
[[nodiscard]] Result<std::vector<SessionSignature>> signaturesIn(const std::filesystem::path& session);
/// Returns the signature in the body of an annotation; nothing if it is another annotation.
[[nodiscard]] std::optional<SessionSignature> signatureIn(const nlohmann::json& body);

enum class SignedReport {
    Unchanged,
    Changed,      ///< it is not what was signed
    SignedAgain,  ///< it was changed and then signed again: the later signature counts
    Missing       ///< it is not there, or cannot be read
};
struct CheckedSignature {
    SessionSignature signature;
    SignedReport state = SignedReport::Missing;
};
/// Compares the reports with their signatures, which are in the order of signing.
[[nodiscard]] std::vector<CheckedSignature> checkSignatures(const std::filesystem::path& session,
                                                            const std::vector<SessionSignature>& signatures);
/// Returns "unchanged", "changed", "signed again", "missing".
[[nodiscard]] std::string_view nameOf(SignedReport state) noexcept;
/// "A. Lind signed run.pdf at 2026-11-20T14:03:05Z; it is unchanged since."
[[nodiscard]] std::string sentenceOf(const CheckedSignature& signature);

}  // namespace tacto
