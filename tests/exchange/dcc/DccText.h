// DccText.h - digital calibration certificates as text, for tests: what a laboratory would send.
//
// Thread-safety: pure functions.
#pragma once

#include <fmt/format.h>
#include <string>

namespace tacto::test {

/// What stands in a certificate; each part may be replaced by one that is wrong.
struct DccText {
    std::string head = R"(<?xml version="1.0" encoding="UTF-8"?>)";
    std::string root = R"(xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si" schemaVersion="3.3.0")";
    std::string number = "K-17", laboratory = "DAkkS Lab", ended = "2026-11-01";
    std::string manufacturer = "Rigol", model = "DS1054Z", serial = "DS1ZA1";
    std::string due = "2027-10-31";  ///< empty: not stated
    std::string statements;          ///< more of them
    std::string items;               ///< more of them
    std::string results;             ///< <dcc:result> elements
    std::string tail;                ///< before the end of the root

    [[nodiscard]] std::string text() const {
        const auto recalibration =
            due.empty()
                ? std::string()
                : fmt::format(R"(<dcc:statement refType="basic_recalibration"><dcc:date>{}</dcc:date></dcc:statement>)",
                              due);
        const auto all = recalibration + statements;
        return fmt::format(
            R"({0}<dcc:digitalCalibrationCertificate {1}><dcc:administrativeData><dcc:dccSoftware><dcc:software>
<dcc:name><dcc:content>By hand</dcc:content></dcc:name><dcc:release>1</dcc:release></dcc:software></dcc:dccSoftware>
<dcc:coreData><dcc:countryCodeISO3166_1>DE</dcc:countryCodeISO3166_1>
<dcc:usedLangCodeISO639_1>en</dcc:usedLangCodeISO639_1>
<dcc:mandatoryLangCodeISO639_1>en</dcc:mandatoryLangCodeISO639_1>
<dcc:uniqueIdentifier>{2}</dcc:uniqueIdentifier><dcc:beginPerformanceDate>2026-10-30</dcc:beginPerformanceDate>
<dcc:endPerformanceDate>{3}</dcc:endPerformanceDate><dcc:performanceLocation>laboratory</dcc:performanceLocation>
</dcc:coreData><dcc:items><dcc:item><dcc:name><dcc:content lang="de">Oszilloskop</dcc:content><dcc:content
lang="en">instrument</dcc:content></dcc:name><dcc:manufacturer><dcc:name>
<dcc:content>{4}</dcc:content></dcc:name>
</dcc:manufacturer><dcc:model>{5}</dcc:model><dcc:identifications><dcc:identification>
<dcc:issuer>manufacturer</dcc:issuer>
<dcc:value>{6}</dcc:value><dcc:name><dcc:content lang="en">Serial number</dcc:content></dcc:name>
</dcc:identification></dcc:identifications></dcc:item>{7}</dcc:items>
<dcc:calibrationLaboratory><dcc:contact><dcc:name>
<dcc:content>{8}</dcc:content>
</dcc:name><dcc:location><dcc:city>Town</dcc:city></dcc:location></dcc:contact></dcc:calibrationLaboratory>
<dcc:respPersons><dcc:respPerson><dcc:person><dcc:name><dcc:content>Ada</dcc:content></dcc:name></dcc:person>
</dcc:respPerson></dcc:respPersons><dcc:customer><dcc:name><dcc:content>Us</dcc:content></dcc:name>
<dcc:location><dcc:city>Town</dcc:city></dcc:location></dcc:customer>{9}</dcc:administrativeData>
<dcc:measurementResults><dcc:measurementResult><dcc:name>
<dcc:content lang="en">Calibration</dcc:content></dcc:name><dcc:results>{10}</dcc:results></dcc:measurementResult>
</dcc:measurementResults>{11}</dcc:digitalCalibrationCertificate>)",
            head, root, number, ended, manufacturer, model, serial, items, laboratory,
            all.empty() ? all : "<dcc:statements>" + all + "</dcc:statements>", results, tail);
    }
};

/// A result whose quantities belong together.
inline std::string dccResult(const std::string& name, const std::string& quantities) {
    return fmt::format(
        R"(<dcc:result><dcc:name><dcc:content lang="en">{}</dcc:content></dcc:name><dcc:data><dcc:list>{}</dcc:list>)"
        "</dcc:data></dcc:result>",
        name, quantities);
}

/// A list of numbers; `u` and `k` empty: without uncertainty.
inline std::string dccQuantity(const std::string& refType, const std::string& name, const std::string& values,
                               const std::string& unit, const std::string& u = {}, const std::string& k = {}) {
    const auto uncertainty =
        u.empty() ? std::string()
                  : fmt::format(
                        "<si:expandedUncXMLList><si:uncertaintyXMLList>{}</si:uncertaintyXMLList>{}"
                        "<si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList>"
                        "<si:distributionXMLList>normal</si:distributionXMLList></si:expandedUncXMLList>",
                        u, k.empty() ? "" : "<si:coverageFactorXMLList>" + k + "</si:coverageFactorXMLList>");
    return fmt::format(
        R"(<dcc:quantity refType="{}"><dcc:name><dcc:content lang="en">{}</dcc:content></dcc:name><si:realListXMLList>)"
        "<si:valueXMLList>{}</si:valueXMLList><si:unitXMLList>{}</si:unitXMLList>{}</si:realListXMLList></"
        "dcc:quantity>",
        refType, name, values, unit, uncertainty);
}

/// The same for one number, as D-SI writes it from 2.2 on.
inline std::string dccReal(const std::string& refType, const std::string& name, const std::string& value,
                           const std::string& unit, const std::string& u, const std::string& k) {
    return fmt::format(
        R"(<dcc:quantity refType="{}"><dcc:name><dcc:content lang="en">{}</dcc:content></dcc:name><si:real>)"
        "<si:value>{}</si:value><si:unit>{}</si:unit><si:measurementUncertaintyUnivariate><si:expandedMU>"
        "<si:valueExpandedMU>{}</si:valueExpandedMU><si:coverageFactor>{}</si:coverageFactor>"
        "<si:coverageProbability>0.95</si:coverageProbability></si:expandedMU></si:measurementUncertaintyUnivariate>"
        "</si:real></dcc:quantity>",
        refType, name, value, unit, u, k);
}

}  // namespace tacto::test
