#include "core/exchange/dcc/DccSignature.h"

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

namespace tacto {

namespace {

template <auto destroy>
struct Destroys {
    template <class T>
    void operator()(T* each) const noexcept {
        static_cast<void>(destroy(each));
    }
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

/// The name in the certificate of the key that fits.
std::string signerOf(const xmlSecDSigCtx& context) {
    auto* data = context.signKey == nullptr ? nullptr : xmlSecKeyGetData(context.signKey, xmlSecKeyDataX509Id);
    auto* certificate = data == nullptr ? nullptr : xmlSecOpenSSLKeyDataX509GetKeyCert(data);
    const Bytes out(BIO_new(BIO_s_mem()));
    if (certificate == nullptr || !out) return {};
    const unsigned long likeRfc2253 = XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB;
    if (X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0, likeRfc2253) < 0) return {};
    char* text = nullptr;
    const long length = BIO_get_mem_data(out.get(), &text);
    return length > 0 ? printable({text, static_cast<std::size_t>(length)}) : std::string();
}

Result<std::string> checkOne(xmlNode& signature) {
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
        return fail(ErrorCode::ParseError, "its signature does not fit: it was altered after it was signed");
    bool all = false;
    const auto& references = context->signedInfoReferences;
    for (xmlSecSize i = 0; i < xmlSecPtrListGetSize(const_cast<xmlSecPtrList*>(&references)); ++i) {
        const auto* each =
            static_cast<xmlSecDSigReferenceCtx*>(xmlSecPtrListGetItem(const_cast<xmlSecPtrList*>(&references), i));
        all = all || (each != nullptr && coversAll(*each));
    }
    if (!all) return fail(ErrorCode::ParseError, "its signature covers only a part of it");
    return signerOf(*context);
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
        if (xmlSecCheckNodeName(node, xmlSecNodeSignature, xmlSecDSigNs) == 0) continue;
        if (found.there)
            return fail(ErrorCode::ParseError, "it has several signatures; one of the whole certificate is expected");
        auto signer = checkOne(*node);
        if (!signer) return failure(signer);
        found = {true, std::move(*signer)};
    }
    return found;
}

}  // namespace tacto
