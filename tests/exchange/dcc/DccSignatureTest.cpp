// Signatures that xmlsec1 makes: they hold, and nothing of what they sign can be changed.
#include <chrono>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/base/Csv.h"
#include "core/exchange/dcc/DccCertificate.h"
#include "tests/exchange/dcc/DccText.h"
#include "tests/support/PythonEnvironment.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kEnveloped =
    R"(<ds:Transform Algorithm="http://www.w3.org/2000/09/xmldsig#enveloped-signature"/>)";

/// What xmlsec1 fills in. `method`: the end of the name of a signature method.
std::string signatureTemplate(const std::string& method = "ecdsa-sha256", const std::string& uri = "",
                              const std::string& transforms = kEnveloped,
                              const std::string& digest = "http://www.w3.org/2001/04/xmlenc#sha256") {
    return fmt::format(
        R"(<ds:Signature xmlns:ds="http://www.w3.org/2000/09/xmldsig#"><ds:SignedInfo><ds:CanonicalizationMethod )"
        R"(Algorithm="http://www.w3.org/2001/10/xml-exc-c14n#"/><ds:SignatureMethod )"
        R"(Algorithm="http://www.w3.org/{}"/><ds:Reference URI="{}"><ds:Transforms>{}</ds:Transforms>)"
        R"(<ds:DigestMethod Algorithm="{}"/><ds:DigestValue/></ds:Reference></ds:SignedInfo><ds:SignatureValue/>)"
        R"(<ds:KeyInfo><ds:X509Data/></ds:KeyInfo></ds:Signature>)",
        method.starts_with("2") ? method : "2001/04/xmldsig-more#" + method, uri, transforms, digest);
}

DccText unsignedDcc() {
    DccText dcc;
    dcc.results =
        dccResult("Voltage", dccQuantity("basic_measuredValue", "Indicated", "1.25 2.5 10", "\\volt", "0.01", "2"));
    return dcc;
}

class DccSignatures : public testing::Test {
protected:
    void SetUp() override {
        const auto made =
            outputOfShell("cd '" + folder_.path().string() +
                          "' && openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -keyout "
                          "key.pem -out cert.pem -days 2 -subj '/CN=Lab Ü/O=Calibration' -utf8 && openssl "
                          "req -x509 -newkey rsa:2048 -nodes -keyout rsa.pem -out rsacert.pem -days 2 -subj "
                          "/CN=Other");
        ASSERT_EQ(made.code, 0) << made.text;
    }
    [[nodiscard]] std::string signedBy(const std::string& text, const std::string& key = "key.pem,cert.pem") const {
        folder_.write("plain.xml", text);
        const auto made = outputOfShell("cd '" + folder_.path().string() +
                                        "' && xmlsec1 --sign --id-attr:Id measurementResults "
                                        "--privkey-pem " +
                                        key + " --output signed.xml plain.xml");
        EXPECT_EQ(made.code, 0) << made.text;
        return readTextFile(folder_.path() / "signed.xml").value_or("");
    }
    void refuses(const std::string& text, const char* why) const {
        const auto file = dccFrom(text, "file.xml");
        ASSERT_FALSE(file) << why;
        EXPECT_THAT(file.error().message, HasSubstr(why));
    }
    const ScratchDir folder_;
};

TEST_F(DccSignatures, HoldAndNameTheirSigner) {
    auto dcc = unsignedDcc();
    EXPECT_FALSE(dccFrom(dcc.text(), "file.xml")->signature.there);
    dcc.tail = signatureTemplate();
    const auto file = dccFrom(signedBy(dcc.text()), "file.xml");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(file->signature.there);
    EXPECT_EQ(file->signature.signer, "O=Calibration,CN=Lab Ü");
    auto openssl = outputOfShell("cd '" + folder_.path().string() + "' && openssl x509 -in cert.pem -noout -sha256 " +
                                 "-fingerprint | cut -d= -f2 | tr 'A-F' 'a-f' | tr -d '\\n'");
    EXPECT_EQ(file->signature.fingerprint, openssl.text);
    // Who signed is not vouched for: anybody can sign under any name.
    auto given = Certificate{};
    given.gain_pct = 1;
    const auto said = certificateFrom({&*file, 1}, given);
    ASSERT_TRUE(said) << said.error().message;
    EXPECT_THAT(said->notes, testing::Contains(testing::AllOf(HasSubstr("nobody vouches for"), HasSubstr("Lab Ü"),
                                                              HasSubstr(openssl.text))));
    dcc.tail = signatureTemplate("rsa-sha512", "", kEnveloped, "http://www.w3.org/2001/04/xmlenc#sha512");
    const auto rsa = dccFrom(signedBy(dcc.text(), "rsa.pem,rsacert.pem"), "file.xml");
    ASSERT_TRUE(rsa) << rsa.error().message;
    EXPECT_EQ(rsa->signature.signer, "CN=Other");
}

/// What is read of a certificate, as text.
std::string readOf(const DccFile& file) {
    auto text = fmt::format("{};{};{};{};{};{}", file.number, file.laboratory, file.begun, file.ended,
                            fmt::join(file.recalibrations, " "), file.simulated);
    for (const auto& item : file.items)
        text += fmt::format(";{};{};{};{}", item.name, item.manufacturer, item.model, item.serial);
    for (const auto& quantity : file.quantities) {
        text += ";" + quantity.name + quantity.within + quantity.unit + quantity.distribution;
        for (const auto& each : quantity.refTypes) text += "," + each;
        for (const auto* all : {&quantity.values, &quantity.uncertainties, &quantity.coverageFactors})
            for (const double each : *all) text += fmt::format(" {}", each);
    }
    return text;
}

TEST_F(DccSignatures, AreRefusedWhenAByteIsAltered) {
    RecordProperty("hazard", "H9");
    auto dcc = unsignedDcc();
    dcc.tail = signatureTemplate();
    const auto whole = signedBy(dcc.text());
    const auto original = dccFrom(whole, "file.xml");
    ASSERT_TRUE(original) << original.error().message;
    const auto signature = whole.find("<ds:Signature");
    std::mt19937 random(7);
    const auto isWord = [](char each) { return (each >= '0' && each <= '9') || (each >= 'a' && each <= 'z'); };
    int altered = 0;
    while (altered < trials<int>({.local = 300, .ci = 2000, .campaign = 20'000})) {
        // Letters and digits of the texts: each stays XML and is content.
        const auto at = random() % signature;
        const auto before = whole.find_last_of("<>", at);
        if (!isWord(whole[at]) || before == std::string::npos || whole[before] != '>') continue;
        auto changed = whole;
        while (changed[at] == whole[at] || !isWord(changed[at])) changed[at] = static_cast<char>(random() % 128);
        ++altered;
        refuses(changed, "was altered, or the key in it is not the one that signed");
    }
    // A comment is not signed, and changes nothing of what is read.
    int read = 0;
    for (int trial = 0; trial < trials<int>({.local = 300, .ci = 2000, .campaign = 20'000}); ++trial) {
        const auto at = random() % signature;
        const auto before = whole.find_last_of("<>", at - 1);
        if (at == 0 || before == std::string::npos || whole[before] != '>') continue;
        auto changed = whole;
        changed.insert(at, random() % 2 == 0 ? "<!---->" : "<!-- --> <!-- -->");
        const auto file = dccFrom(changed, "file.xml");
        if (!file) continue;
        ++read;
        EXPECT_EQ(readOf(*file), readOf(*original)) << changed.substr(at - 20, 60);
    }
    EXPECT_GT(read, 0);
    // Any bytes anywhere: refused, unsigned, or the same is read, as when a blank between attributes became another.
    for (int trial = 0; trial < trials<int>({.local = 1000, .ci = 5000, .campaign = 100'000}); ++trial) {
        auto changed = whole;
        for (auto count = 1 + random() % 3; count > 0; --count)
            changed[random() % changed.size()] = static_cast<char>(random());
        const auto file = dccFrom(changed, "file.xml");
        if (!file) continue;
        // Without its signature a file is another one, and said to be unsigned.
        EXPECT_TRUE(!file->signature.there || readOf(*file) == readOf(*original)) << readOf(*file);
        EXPECT_TRUE(file->signature.there || changed.find("<ds:Signature") == std::string::npos ||
                    changed.find("xmlns:ds=\"http://www.w3.org/2000/09/xmldsig#\"") == std::string::npos);
    }
}

TEST_F(DccSignatures, AreRefusedIfTheyDoNotCoverTheWholeOrAreWeak) {
    RecordProperty("hazard", "H9");
    const auto dcc = [](const std::string& tail) {
        auto with = unsignedDcc();
        with.tail = tail;
        auto text = with.text();
        const std::string part = "<dcc:measurementResults>";
        text.replace(text.find(part), part.size(), "<dcc:measurementResults Id=\"part\">");
        return text;
    };
    refuses(signedBy(dcc(signatureTemplate("ecdsa-sha256", "#part"))), "only a part");
    refuses(signedBy(dcc(signatureTemplate(
                "ecdsa-sha256", "",
                std::string(kEnveloped) +
                    R"(<ds:Transform Algorithm="http://www.w3.org/TR/1999/REC-xpath-19991116">)"
                    "<ds:XPath>ancestor-or-self::*[local-name()='coreData']</ds:XPath></ds:Transform>"))),
            "cannot be checked");
    refuses(signedBy(dcc(signatureTemplate("ecdsa-sha256", "", kEnveloped, "http://www.w3.org/2000/09/xmldsig#sha1"))),
            "cannot be checked");
    refuses(signedBy(dcc(signatureTemplate("2000/09/xmldsig#rsa-sha1")), "rsa.pem,rsacert.pem"), "cannot be checked");
    refuses(dcc(signatureTemplate()), "cannot be checked");  // never filled in
    const auto one = signedBy(dcc(signatureTemplate()));
    auto two = one;
    two.insert(two.find("<ds:Signature"),
               one.substr(one.find("<ds:Signature"), one.find("</ds:Signature>") + 15 - one.find("<ds:Signature")));
    refuses(two, "");
    // Elsewhere than below the root, at a depth drawn at random.
    std::mt19937 random(11);
    for (int trial = 0; trial < 20; ++trial) {
        const auto begin = one.find("<ds:Signature"), end = one.find("</ds:Signature>") + 15;
        std::string open, close;
        for (auto depth = 1 + random() % 20; depth > 0; --depth) {
            open += "<dcc:comment>";
            close += "</dcc:comment>";
        }
        refuses(one.substr(0, begin) + open + one.substr(begin, end - begin) + close + one.substr(end),
                "a signature stands within its");
    }
    // References that name no element, or too many, are refused before anything is computed.
    const auto reference =
        one.substr(one.find("<ds:Reference"), one.find("</ds:Reference>") + 15 - one.find("<ds:Reference"));
    std::string many = "<dcc:comment>";
    for (int i = 0; i < 60'000; ++i) many += "<a/>";
    many += "</dcc:comment>";
    const auto began = std::chrono::steady_clock::now();
    for (const std::string uri : {"#xpointer(//*[count(//*[count(//*)&gt;1])&gt;1])", "#xpointer(id('part'))", "#",
                                  "#a b", "file:///dev/zero", "http://localhost/"}) {
        auto text = one;
        auto other = reference;
        other.replace(other.find("URI=\"\""), 6, "URI=\"" + uri + "\"");
        text.insert(text.find("<ds:Reference"), other);
        text.insert(text.find("<ds:Signature"), many);
        refuses(text, "at most 4 references");
    }
    auto five = one;
    for (int i = 0; i < 4; ++i) five.insert(five.find("<ds:Reference"), reference);
    refuses(five, "at most 4 references");
    auto manifest = one;
    manifest.insert(manifest.find("</ds:Signature>"),
                    "<ds:Object><ds:Manifest>" + reference + "</ds:Manifest></ds:Object>");
    refuses(manifest, "no manifest");
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(30));
    // A key that fits nothing.
    auto other = dcc(signatureTemplate("rsa-sha256"));
    other = signedBy(other, "rsa.pem,rsacert.pem");
    const auto cut = [](const std::string& text, const char* element) {
        const auto begin = text.find(fmt::format("<ds:{}>", element));
        return text.substr(begin, text.find(fmt::format("</ds:{}>", element)) - begin);
    };
    auto swapped = one;
    swapped.replace(swapped.find(cut(one, "KeyInfo")), cut(one, "KeyInfo").size(), cut(other, "KeyInfo"));
    refuses(swapped, "");
}

}  // namespace
}  // namespace tacto::test
