// DccExport.h - the results of a stimulator's calibration as digital calibration certificate: PTB's DCC 3.3.0 with
// quantities in D-SI 2.2.1. A part of the exports.
//
// It says what the printed certificate says (app/report/CertificatePages.h): as found and as left, set, delivered and
// error with U, k and coverage probability. What was not entered is "unknown" ("ZZ" for the
// country, which ISO 3166 leaves to its users), and a statement lists that. It is not signed and says so.
//
// Thread-safety: as ExportSource.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

/// Its write(): Unsupported for a session without a certificate's results, a run that did not come to its verdict,
/// readings from files, or a damaged session.
[[nodiscard]] const ExportFormat& dccExport();

}  // namespace tacto
