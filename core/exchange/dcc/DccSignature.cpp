#include "core/exchange/dcc/DccSignature.h"

#include <algorithm>
#include <array>
#include <libxml/parser.h>
#include <memory>
#include <openssl/bio.h>
#include <openssl/x509.h>
#include <vector>
#include <xmlsec/crypto.h>
#include <xmlsec/errors.h>
#include <xmlsec/xmldsig.h>
#include <xmlsec/xmlsec.h>
#include <xmlsec/xmltree.h>

#include "core/base/Printable.h"
#include "core/exchange/dcc/DccFile.h"

namespace tacto {

namespace {

template <auto destroy>
struct Destroys {
    template <class T>
    void operator()(T* each) const noexcept {
        static_cast<void>(destroy(each));
    }
};
struct FreesText {
    void operator()(xmlChar* text) const noexcept { xmlFree(text); }
};
using Document = std::unique_ptr<xmlDoc, Destroys<xmlFreeDoc>>;
using Keys = std::unique_ptr<xmlSecKeysMngr, Destroys<xmlSecKeysMngrDestroy>>;
using Context = std::unique_ptr<xmlSecDSigCtx, Destroys<xmlSecDSigCtxDestroy>>;
using Bytes = std::unique_ptr<BIO, Destroys<BIO_free>>;

/// Begins xmlsec once; it lasts as long as the program.
bool ready() {
    static const bool begun = [] {
        xmlInitParser();
        xmlSecErrorsDefaultCallbackEnableOutput(0);
        return xmlSecInit() == 0 && xmlSecCryptoAppInit(nullptr) == 0 && xmlSecCryptoInit() == 0;
    }();
    return begun;
}

std::vector<xmlSecTransformId> canonical() {
    return {xmlSecTransformInclC14NId,   xmlSecTransformInclC14NWithCommentsId,
            xmlSecTransformInclC14N11Id, xmlSecTransformInclC14N11WithCommentsId,
            xmlSecTransformExclC14NId,   xmlSecTransformExclC14NWithCommentsId};
}

/// Whether this part of the signature covers the whole document; the transforms that contextFor() accepts leave out
/// the signature itself, or comments, and nothing else.
bool coversAll(const xmlSecDSigReferenceCtx& reference) { return reference.uri != nullptr && *reference.uri == 0; }

/// Only what keeps all content may come between the document and its digest, and the network is never asked.
Context contextFor(xmlSecKeysMngr* keys) {
    Context context(xmlSecDSigCtxCreate(keys));
    if (!context) return context;
    auto& info = context->keyInfoReadCtx;
    info.flags |= XMLSEC_KEYINFO_FLAGS_X509DATA_DONT_VERIFY_CERTS;
    info.maxRetrievalMethodLevel = 0;
    info.maxEncryptedKeyLevel = 0;
    info.retrievalMethodCtx.enabledUris = xmlSecTransformUriTypeNone;
    bool sound = true;
    for (const auto id : {xmlSecKeyDataX509Id, xmlSecKeyDataRsaId, xmlSecKeyDataValueId})
        sound = sound && xmlSecPtrListAdd(&info.enabledKeyData, const_cast<void*>(static_cast<const void*>(id))) == 0;
    context->enabledReferenceUris = xmlSecTransformUriTypeEmpty | xmlSecTransformUriTypeSameDocument;
    for (const auto id : canonical()) {
        sound = sound && xmlSecDSigCtxEnableReferenceTransform(context.get(), id) == 0 &&
                xmlSecDSigCtxEnableSignatureTransform(context.get(), id) == 0;
    }
    for (const auto id :
         {xmlSecTransformEnvelopedId, xmlSecTransformSha256Id, xmlSecTransformSha384Id, xmlSecTransformSha512Id})
        sound = sound && xmlSecDSigCtxEnableReferenceTransform(context.get(), id) == 0;
    for (const auto id : {xmlSecTransformRsaSha256Id, xmlSecTransformRsaSha384Id, xmlSecTransformRsaSha512Id,
                          xmlSecTransformEcdsaSha256Id, xmlSecTransformEcdsaSha384Id, xmlSecTransformEcdsaSha512Id})
        sound = sound && xmlSecDSigCtxEnableSignatureTransform(context.get(), id) == 0;
    return sound ? std::move(context) : Context();
}

/// The name in a certificate.
std::string nameIn(X509& certificate) {
    const Bytes out(BIO_new(BIO_s_mem()));
    if (!out) return {};
    const unsigned long likeRfc2253 = XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB;
    if (X509_NAME_print_ex(out.get(), X509_get_subject_name(&certificate), 0, likeRfc2253) < 0) return {};
    char* text = nullptr;
    const long length = BIO_get_mem_data(out.get(), &text);
    constexpr long kLongest = 300;
    return length > 0 ? printable({text, static_cast<std::size_t>(std::min(length, kLongest))}) : std::string();
}

std::string fingerprintOf(X509& certificate) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    if (X509_digest(&certificate, EVP_sha256(), digest.data(), &length) != 1) return {};
    std::string text;
    for (unsigned i = 0; i < length; ++i) text += fmt::format("{}{:02x}", i == 0 ? "" : ":", digest[i]);
    return text;
}

/// What the certificate of the key that fits says.
DccSignature signatureBy(const xmlSecDSigCtx& context) {
    auto* data = context.signKey == nullptr ? nullptr : xmlSecKeyGetData(context.signKey, xmlSecKeyDataX509Id);
    auto* certificate = data == nullptr ? nullptr : xmlSecOpenSSLKeyDataX509GetKeyCert(data);
    if (certificate == nullptr) return {.there = true};
    return {.there = true, .signer = nameIn(*certificate), .fingerprint = fingerprintOf(*certificate)};
}

bool isOf(xmlNode* node, const xmlChar* name) { return xmlSecCheckNodeName(node, name, xmlSecDSigNs) != 0; }

/// "", or "#" and an Id. All else is a language of its own, in which a short text can take for ever.
bool namesAnElement(std::string_view uri) {
    constexpr std::string_view kSigns = "-_.";
    return uri.empty() || (uri.size() > 1 && uri.front() == '#' && std::ranges::all_of(uri.substr(1), [&](char each) {
                               return (each >= '0' && each <= '9') || (each >= 'A' && each <= 'Z') ||
                                      (each >= 'a' && each <= 'z') || kSigns.find(each) != std::string_view::npos;
                           }));
}

/// Counts the references in `node` and what is within it; false: one of them is none that is accepted, or it has a
/// manifest, which is a list of more.
bool hasSoundReferences(xmlNode* node, int& count) {
    constexpr int kMaxReferences = 4;
    if (isOf(node, xmlSecNodeManifest)) return false;
    if (isOf(node, xmlSecNodeReference)) {
        const std::unique_ptr<xmlChar, FreesText> uri(xmlGetProp(node, xmlSecAttrURI));
        if (++count > kMaxReferences || !uri || !namesAnElement(reinterpret_cast<const char*>(uri.get()))) return false;
    }
    for (auto* each = node->children; each != nullptr; each = each->next)
        if (!hasSoundReferences(each, count)) return false;
    return true;
}

/// The first signature in `node`, itself or within it.
xmlNode* signatureIn(xmlNode* node) {
    if (isOf(node, xmlSecNodeSignature)) return node;
    for (auto* each = node->children; each != nullptr; each = each->next)
        if (auto* found = signatureIn(each)) return found;
    return nullptr;
}

Result<DccSignature> checkOne(xmlNode& signature) {
    if (int count = 0; !hasSoundReferences(&signature, count))
        return fail(
            ErrorCode::ParseError,
            "its signature cannot be checked: at most 4 references, to the whole certificate or to an Id in it, "
            "and no manifest are expected");
    const Keys keys(xmlSecKeysMngrCreate());
    if (!keys || xmlSecCryptoAppDefaultKeysMngrInit(keys.get()) != 0)
        return fail(ErrorCode::Unsupported, "its signature cannot be checked here");
    const auto context = contextFor(keys.get());
    if (!context) return fail(ErrorCode::Unsupported, "its signature cannot be checked here");
    if (xmlSecDSigCtxVerify(context.get(), &signature) != 0)
        return fail(ErrorCode::ParseError,
                    "its signature cannot be checked: an enveloped one of the whole certificate is expected, with "
                    "SHA-256 or longer, by an RSA or elliptic key that stands in it");
    if (context->status != xmlSecDSigStatusSucceeded)
        return fail(ErrorCode::ParseError,
                    "its signature does not fit: the certificate was altered, or the key in it is not the one that "
                    "signed");
    bool all = false;
    const auto& references = context->signedInfoReferences;
    for (xmlSecSize i = 0; i < xmlSecPtrListGetSize(const_cast<xmlSecPtrList*>(&references)); ++i) {
        const auto* each =
            static_cast<xmlSecDSigReferenceCtx*>(xmlSecPtrListGetItem(const_cast<xmlSecPtrList*>(&references), i));
        all = all || (each != nullptr && coversAll(*each));
    }
    if (!all) return fail(ErrorCode::ParseError, "its signature covers only a part of it");
    return signatureBy(*context);
}

}  // namespace

Result<DccSignature> checkDccSignature(std::string_view xml) {
    if (!ready()) return fail(ErrorCode::Unsupported, "signatures cannot be checked here: xmlsec does not begin");
    constexpr int kQuiet = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING;
    const Document document(
        xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "certificate.xml", "UTF-8", kQuiet));
    auto* root = document ? xmlDocGetRootElement(document.get()) : nullptr;
    if (root == nullptr) return fail(ErrorCode::ParseError, "it is no XML that libxml2 reads");
    const auto asXml = [](const char* name) { return reinterpret_cast<const xmlChar*>(name); };
    std::array<const xmlChar*, 4> ids{asXml("Id"), asXml("ID"), asXml("id"), nullptr};
    xmlSecAddIDs(document.get(), root, ids.data());
    DccSignature found;
    for (auto* node = root->children; node != nullptr; node = node->next) {
        if (signatureIn(node) == nullptr) continue;
        if (!isOf(node, xmlSecNodeSignature))
            return fail(ErrorCode::ParseError,
                        "a signature stands within its {}; one directly below the root, of the whole certificate, is "
                        "expected",
                        shownOf(reinterpret_cast<const char*>(node->name)));
        if (found.there)
            return fail(ErrorCode::ParseError, "it has several signatures; one of the whole certificate is expected");
        auto checked = checkOne(*node);
        if (!checked) return failure(checked);
        found = std::move(*checked);
    }
    return found;
}

}  // namespace tacto
