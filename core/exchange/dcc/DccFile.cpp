#include "core/exchange/dcc/DccFile.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <tuple>
#include <utility>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/Statistics.h"
#include "core/exchange/dcc/DccNames.h"

namespace tacto {

namespace {

using pugi::xml_node;

constexpr std::size_t kShown = 60, kLongestName = 500;  // bytes
constexpr int kDeepest = 64;                            // elements within each other

/// The name without its prefix. The root says which namespace that is.
std::string_view localName(const xml_node& node) {
    const std::string_view name = node.name();
    const auto colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}
bool isCalled(const xml_node& node, std::string_view name) {
    return node.type() == pugi::node_element && localName(node) == name;
}
xml_node childOf(const xml_node& node, std::string_view name) {
    return node.find_child([&](const xml_node& each) { return isCalled(each, name); });
}
template <class... Names>
xml_node below(const xml_node& node, std::string_view first, Names... rest) {
    if constexpr (sizeof...(rest) == 0)
        return childOf(node, first);
    else
        return below(childOf(node, first), rest...);
}
/// All of an element's text. A comment within it, which a signature does not cover, does not end it.
std::string wholeText(const xml_node& node) {
    std::string text;
    for (const auto& each : node.children())
        if (each.type() == pugi::node_pcdata || each.type() == pugi::node_cdata) text += each.value();
    return text;
}
std::string textOf(const xml_node& node) { return std::string(trimmed(wholeText(node))); }

/// The English text of <name>, <description> and the like.
std::string textInEnglish(const xml_node& node) {
    std::string best;
    int found = 0;
    for (const auto& each : node.children()) {
        if (!isCalled(each, "content")) continue;
        const std::string_view language = each.attribute("lang").value();
        const int worth = language == "en" ? 3 : language.empty() ? 2 : 1;
        if (worth <= found) continue;
        found = worth;
        best = textOf(each);
    }
    return best;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    std::vector<std::string_view> words;
    while (true) {
        const auto begin = text.find_first_not_of(kBlank);
        if (begin == std::string_view::npos) return words;
        text.remove_prefix(begin);
        const auto end = std::min(text.find_first_of(kBlank), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}
std::vector<std::string> refTypesOf(const xml_node& node) {
    const auto words = wordsOf(node.attribute("refType").value());
    return {words.begin(), words.end()};
}
bool has(const xml_node& node, std::string_view refType) {
    const auto words = wordsOf(node.attribute("refType").value());
    return std::ranges::find(words, refType) != words.end();
}

struct DepthWalker : pugi::xml_tree_walker {
    int deepest = 0;
    bool for_each(xml_node&) override {
        deepest = std::max(deepest, depth());
        return true;
    }
};

/// Reads the quantities of one certificate. Errors name the quantity.
class QuantityReader {
public:
    QuantityReader(const std::vector<DccItem>& items, std::vector<DccQuantity>& into) : items_(items), into_(into) {}

    [[nodiscard]] Result<void> results(const xml_node& measurementResults) {
        for (const auto& measurement : measurementResults.children()) {
            if (!isCalled(measurement, "measurementResult")) continue;
            const auto outer = within(measurement, {});
            if (!outer) return failure(outer);
            for (const auto& result : childOf(measurement, "results").children()) {
                if (!isCalled(result, "result")) continue;
                const auto inner = within(result, *outer);
                if (!inner) return failure(inner);
                const auto data = childOf(result, "data");
                if (auto done = all(data, {inner->names, itemsOf(data, inner->items)}); !done) return done;
            }
        }
        return {};
    }

private:
    /// What a quantity stands in.
    struct Within {
        std::string names{};
        std::vector<std::size_t> items{};
    };
    /// The name of an element, which goes into each quantity within it.
    [[nodiscard]] static Result<std::string> nameOf(const xml_node& node) {
        auto name = textInEnglish(childOf(node, "name"));
        if (name.size() > kLongestName)
            return fail(ErrorCode::ParseError, "the name \"{}\" has {} bytes; at most {} are accepted", shownOf(name),
                        name.size(), kLongestName);
        return name;
    }
    [[nodiscard]] Result<Within> within(const xml_node& node, const Within& outer) const {
        const auto name = nameOf(node);
        if (!name) return failure(name);
        return Within{outer.names.empty() ? *name : outer.names + "; " + *name, itemsOf(node, outer.items)};
    }
    /// The items to which an element refers, or those of what it stands in.
    [[nodiscard]] std::vector<std::size_t> itemsOf(const xml_node& node, const std::vector<std::size_t>& outer) const {
        const auto ids = wordsOf(node.attribute("refId").value());
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < items_.size(); ++i)
            if (!items_[i].id.empty() && std::ranges::find(ids, items_[i].id) != ids.end()) own.push_back(i);
        return own.empty() ? outer : own;
    }

    /// What stands directly in <data> or <list> belongs together.
    [[nodiscard]] Result<void> all(const xml_node& in, const Within& outer) {
        const auto list = ++lists_;
        for (const auto& each : in.children()) {
            Result<void> done;
            if (isCalled(each, "list")) {
                const auto inner = within(each, outer);
                done = inner ? all(each, *inner) : failure(inner);
            } else if (isCalled(each, "quantity")) {
                done = one(each, outer, list);
            }
            if (!done) return done;
        }
        return {};
    }

    [[nodiscard]] Result<void> one(const xml_node& node, const Within& outer, std::size_t list) {
        auto name = nameOf(node);
        if (!name) return failure(name);
        if (into_.size() == kDccMostQuantities)
            return fail(ErrorCode::ParseError, "it has more than {} quantities, the most that are accepted",
                        kDccMostQuantities);
        DccQuantity quantity{.refTypes = refTypesOf(node),
                             .name = std::move(*name),
                             .within = outer.names,
                             .list = list,
                             .items = itemsOf(node, outer.items)};
        name_ = quantity.name.empty() ? quantity.within : quantity.name;
        auto from = node;
        if (const auto hybrid = childOf(node, "hybrid")) from = hybrid;  // the same in several units: the first
        Result<bool> read = false;
        if (const auto real = childOf(from, "real"))
            read = single(real, quantity);
        else if (const auto values = childOf(from, "realListXMLList"))
            read = listed(values, quantity);
        if (!read) return failure(read);
        if (*read) into_.push_back(std::move(quantity));
        return {};
    }

    static std::optional<double> decimal(std::string_view word) {
        if (word.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return std::nullopt;
        if (!word.starts_with('+')) return parseNumber(word);
        return word.starts_with("+-") || word.starts_with("++") ? std::nullopt : parseNumber(word.substr(1));
    }
    /// Numbers as D-SI allows them: decimal, with or without exponent, or NaN.
    [[nodiscard]] Result<std::vector<double>> numbers(const xml_node& node, std::string_view what) const {
        std::vector<double> all;
        const auto text = wholeText(node);
        for (const auto word : wordsOf(text)) {
            const auto number = word == "NaN" ? std::optional(kNaN) : decimal(word);
            if (!number)
                return fail(ErrorCode::ParseError, "{} of \"{}\" is \"{}\"; a decimal number or NaN is expected", what,
                            shownOf(name_), shownOf(word));
            all.push_back(*number);
        }
        if (all.empty()) return fail(ErrorCode::ParseError, "{} of \"{}\" is missing", what, shownOf(name_));
        return all;
    }

    /// Numbers for each value; a single one is for all of them.
    [[nodiscard]] Result<std::vector<double>> forEach(const xml_node& node, std::string_view what,
                                                      std::size_t count) const {
        auto all = numbers(node, what);
        if (!all) return all;
        if (all->size() == 1) all->resize(count, all->front());
        if (all->size() != count)
            return fail(ErrorCode::ParseError,
                        "\"{}\" has {} values and {} numbers for {}; as many, or one, are expected", shownOf(name_),
                        count, all->size(), what);
        return all;
    }

    [[nodiscard]] Result<bool> single(const xml_node& real, DccQuantity& quantity) const {
        auto values = numbers(childOf(real, "value"), "the value");
        if (!values) return failure(values);
        if (values->size() != 1)
            return fail(ErrorCode::ParseError, "\"{}\" has {} values where one is expected", shownOf(name_),
                        values->size());
        quantity.values = std::move(*values);
        if (auto done = unit(childOf(real, "unit"), quantity); !done) return failure(done);
        return uncertainty(real, "", quantity);
    }
    [[nodiscard]] Result<bool> listed(const xml_node& list, DccQuantity& quantity) const {
        auto values = numbers(childOf(list, "valueXMLList"), "the values");
        if (!values) return failure(values);
        quantity.values = std::move(*values);
        if (auto done = unit(childOf(list, "unitXMLList"), quantity); !done) return failure(done);
        return uncertainty(list, "XMLList", quantity);
    }

    [[nodiscard]] Result<void> unit(const xml_node& node, DccQuantity& quantity) const {
        const auto text = wholeText(node);
        const auto words = wordsOf(text);
        if (words.empty()) return fail(ErrorCode::ParseError, "the unit of \"{}\" is missing", shownOf(name_));
        if (words.size() != 1 && words.size() != quantity.values.size())
            return fail(ErrorCode::ParseError, "\"{}\" has {} values and {} units; as many, or one, are expected",
                        shownOf(name_), quantity.values.size(), words.size());
        const auto other = std::ranges::find_if(words, [&](std::string_view each) { return each != words.front(); });
        if (other != words.end())
            return fail(ErrorCode::ParseError, "\"{}\" has values in {} and in {}; one unit is expected",
                        shownOf(name_), shownOf(words.front()), shownOf(*other));
        quantity.unit = words.front();
        return {};
    }

    [[nodiscard]] Result<bool> uncertainty(const xml_node& of, const std::string& ending, DccQuantity& quantity) const {
        const auto inside = [&](const xml_node& node, const char* name) { return childOf(node, name + ending); };
        // D-SI from 2.2 on, and before.
        const auto univariate = inside(of, "measurementUncertaintyUnivariate");
        struct Form {
            xml_node node;
            const char* uncertainty;
            bool expanded;
        };
        const Form forms[] = {{inside(univariate, "expandedMU"), "valueExpandedMU", true},
                              {inside(of, "expandedUnc"), "uncertainty", true},
                              {inside(univariate, "standardMU"), "valueStandardMU", false},
                              {inside(univariate, "coverageIntervalMU"), "valueStandardMU", false},
                              {inside(of, "coverageInterval"), "standardUnc", false}};
        const auto* form = std::ranges::find_if(forms, [](const Form& each) { return bool(each.node); });
        if (form == std::end(forms)) return true;
        const auto count = quantity.values.size();
        const auto read = [&](const char* name, std::string_view what, std::vector<double>& into) -> Result<void> {
            auto all = forEach(inside(form->node, name), what, count);
            if (!all) return failure(all);
            into = std::move(*all);
            return {};
        };
        if (auto done = read(form->uncertainty, "the uncertainty", quantity.uncertainties); !done) return failure(done);
        quantity.coverageFactors.assign(count, 1);
        if (form->expanded) {
            if (auto done = read("coverageFactor", "the coverage factor k", quantity.coverageFactors); !done)
                return failure(done);
            if (auto done = read("coverageProbability", "the coverage probability", quantity.probabilities); !done)
                return failure(done);
        }
        const auto distribution = wholeText(inside(form->node, "distribution"));
        const auto words = wordsOf(distribution);
        if (!words.empty()) quantity.distribution = words.front();
        return judge(quantity);
    }

    /// NaN is absent; all else must be possible.
    [[nodiscard]] Result<bool> judge(const DccQuantity& quantity) const {
        const auto wrong = [&](const std::vector<double>& all, auto&& sound) {
            return std::ranges::find_if(all, [&](double each) { return !std::isnan(each) && !sound(each); });
        };
        const auto& [u, k, p] = std::tie(quantity.uncertainties, quantity.coverageFactors, quantity.probabilities);
        if (const auto at = wrong(u, [](double each) { return each >= 0; }); at != u.end())
            return fail(ErrorCode::ParseError, "the uncertainty of \"{}\" is {}; 0 or more is expected", shownOf(name_),
                        *at);
        if (const auto at = wrong(k, [](double each) { return each >= 1; }); at != k.end())
            return fail(ErrorCode::ParseError, "the coverage factor k of \"{}\" is {}; 1 or more is expected",
                        shownOf(name_), *at);
        if (const auto at = wrong(p, [](double each) { return each >= 0 && each <= 1; }); at != p.end())
            return fail(ErrorCode::ParseError, "the coverage probability of \"{}\" is {}; 0 to 1 is expected",
                        shownOf(name_), *at);
        return true;
    }

    const std::vector<DccItem>& items_;
    std::vector<DccQuantity>& into_;
    std::size_t lists_ = 0;
    std::string name_;
};

std::string serialOf(const xml_node& item) {
    std::string byManufacturer;
    for (const auto& each : childOf(item, "identifications").children()) {
        const auto value = textOf(childOf(each, "value"));
        if (has(each, dcc::kSerial) ||
            lowered(textInEnglish(childOf(each, "name"))).find("serial") != std::string::npos)
            return value;
        if (byManufacturer.empty() && textOf(childOf(each, "issuer")) == "manufacturer") byManufacturer = value;
    }
    return byManufacturer;
}

Result<DccFile> fileFrom(const xml_node& root) {
    DccFile file;
    file.schemaVersion = root.attribute("schemaVersion").value();
    if (!file.schemaVersion.starts_with("3."))
        return fail(ErrorCode::ParseError, "its schemaVersion is \"{}\"; version 3 of the DCC is expected",
                    shownOf(file.schemaVersion));
    const auto administrative = childOf(root, "administrativeData");
    const auto core = childOf(administrative, "coreData");
    for (const auto& [into, name] :
         {std::pair(&file.number, "uniqueIdentifier"), std::pair(&file.begun, "beginPerformanceDate"),
          std::pair(&file.ended, "endPerformanceDate")}) {
        *into = textOf(childOf(core, name));
        if (into->empty()) return fail(ErrorCode::ParseError, "its {} is missing", name);
    }
    file.issued = textOf(childOf(core, "issueDate"));
    file.laboratory = textInEnglish(below(administrative, "calibrationLaboratory", "contact", "name"));
    if (file.laboratory.empty()) return fail(ErrorCode::ParseError, "its laboratory has no name");
    const auto items = childOf(administrative, "items");
    for (const auto& item : items.children()) {
        if (!isCalled(item, "item")) continue;
        auto manufacturer = textInEnglish(below(item, "manufacturer", "name"));
        if (manufacturer.empty()) manufacturer = textInEnglish(below(items, "manufacturer", "name"));
        file.items.push_back({.name = textInEnglish(childOf(item, "name")),
                              .manufacturer = std::move(manufacturer),
                              .model = textOf(childOf(item, "model")),
                              .serial = serialOf(item),
                              .id = item.attribute("id").value()});
    }
    if (file.items.empty()) return fail(ErrorCode::ParseError, "it names no item that was calibrated");
    for (const auto& statement : childOf(administrative, "statements").children()) {
        if (auto day = textOf(childOf(statement, "date")); has(statement, dcc::kRecalibration) && !day.empty())
            file.recalibrations.push_back(std::move(day));
        file.simulated = file.simulated || has(statement, dcc::kSimulated);
    }
    if (auto read = QuantityReader(file.items, file.quantities).results(childOf(root, "measurementResults")); !read)
        return failure(read);
    return file;
}

/// Refuses what a program that reads files of others must not go into.
Result<void> checkBytes(std::string_view bytes) {
    if (bytes.size() > kDccLimit)
        return fail(ErrorCode::ParseError, "it is larger than {} bytes, the most that is accepted", kDccLimit);
    if (!isUtf8(bytes) || bytes.find('\0') != std::string_view::npos)
        return fail(ErrorCode::ParseError, "it is not UTF-8, in which digital certificates are written");
    for (const char* each : {"<!DOCTYPE", "<!ENTITY"})
        if (bytes.find(each) != std::string_view::npos)
            return fail(ErrorCode::ParseError, "it has a document type ({}), which no digital certificate has", each);
    return {};
}

Result<DccFile> readFrom(std::string_view bytes) {
    if (auto sound = checkBytes(bytes); !sound) return failure(sound);
    pugi::xml_document document;
    const auto parsed = document.load_buffer(bytes.data(), bytes.size(),
                                             pugi::parse_default | pugi::parse_declaration | pugi::parse_ws_pcdata,
                                             pugi::encoding_utf8);
    if (!parsed) return fail(ErrorCode::ParseError, "it is no XML: {} at byte {}", parsed.description(), parsed.offset);
    const std::string_view encoding = document.first_child().type() == pugi::node_declaration
                                          ? document.first_child().attribute("encoding").value()
                                          : "";
    if (!encoding.empty() && lowered(encoding) != "utf-8")
        return fail(ErrorCode::ParseError, "it says that its encoding is \"{}\"; UTF-8 is expected", shownOf(encoding));
    const auto root = document.document_element();
    const std::string_view name = root.name();
    const auto colon = name.rfind(':');
    const auto declares =
        colon == std::string_view::npos ? std::string("xmlns") : "xmlns:" + std::string(name.substr(0, colon));
    if (!isCalled(root, "digitalCalibrationCertificate") ||
        std::string_view(root.attribute(declares.c_str()).value()) != dcc::kNamespace)
        return fail(ErrorCode::ParseError, "its root is \"{}\"; a digitalCalibrationCertificate of {} is expected",
                    shownOf(name), dcc::kNamespace);
    DepthWalker walker;  // a tree as deep as it likes ends what goes through it by calling itself
    document.traverse(walker);
    if (walker.deepest > kDeepest)
        return fail(ErrorCode::ParseError, "its elements are nested {} deep; at most {} are accepted", walker.deepest,
                    kDeepest);
    auto signature = checkDccSignature(bytes);
    if (!signature) return failure(signature);
    auto file = fileFrom(root);
    if (file) file->signature = std::move(*signature);
    return file;
}

}  // namespace

std::string shownOf(std::string_view text) {
    if (text.size() <= kShown) return printable(text);
    return printable(text.substr(0, kShown)) + "…";
}

bool DccQuantity::is(std::string_view refType) const { return std::ranges::find(refTypes, refType) != refTypes.end(); }

Result<DccFile> readDcc(const std::filesystem::path& path) {
    const auto bytes = readTextFile(path, kDccLimit);
    if (!bytes) return failure(bytes);
    return dccFrom(*bytes, path.string());
}

Result<DccFile> dccFrom(std::string_view bytes, std::string_view name) {
    auto file = readFrom(bytes);
    if (!file) return fail(file.error().code, "{}: {}", name, file.error().message);
    return file;
}

}  // namespace tacto
