// DccSignature.h - the enveloped XML signature of a digital calibration certificate (W3C, XML Signature Syntax and
// Processing 1.1), checked by xmlsec.
//
// A signature says that nothing was changed since it was made, and with which key. Whose key that is says the
// certificate in it, which nobody here vouches for: the program knows no authorities.
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
};

/// `xml` was read as XML without a document type. Errors: ParseError if a signature does not fit the content, covers
/// only a part of it, or is made in a way that is not accepted: only transforms that keep all content, no SHA-1 and no
/// shared secrets.
[[nodiscard]] Result<DccSignature> checkDccSignature(std::string_view xml);

}  // namespace tacto
