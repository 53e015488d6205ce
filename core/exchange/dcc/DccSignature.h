// DccSignature.h - the enveloped XML signature of a digital calibration certificate (W3C, XML Signature Syntax and
// Processing 1.1), checked by xmlsec.
//
// A signature says that nothing was changed since it was made, and with which key. Whose key that is says the
// certificate in it, which is not checked against any authority.
//
// Thread-safety: any thread.
#pragma once

#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

struct DccSignature {
    bool there = false;    ///< false: unsigned
    std::string signer{};  ///< as the certificate in it names it, "CN=..."; empty: a bare key
    /// SHA-256 of that certificate, as "ab:01:..."; empty: a bare key.
    std::string fingerprint{};
};

/// `xml` was read as XML without a document type, and is not nested deep. Errors: ParseError if a signature does not
/// fit the content, covers only a part of it, stands elsewhere than directly below the root, or is made in a way that
/// is not accepted: at most 4 references, to the whole or to an Id, only transforms that keep all content, no SHA-1 and
/// no shared secrets.
[[nodiscard]] Result<DccSignature> checkDccSignature(std::string_view xml);

}  // namespace tacto
