#include "core/analysis/identification/Encodings.h"

#include "core/analysis/statistics/Binomial.h"

namespace tacto {

EncodingComparison compareEncodings(std::vector<EncodingResult> inOrder, std::string preferred) {
    EncodingComparison out;
    for (std::size_t earlier = 0; earlier < inOrder.size(); ++earlier) {
        for (std::size_t later = earlier + 1; later < inOrder.size(); ++later) {
            const auto &a = inOrder[later], &b = inOrder[earlier];
            out.pairs.push_back({a.encoding, b.encoding, newcombeDifference(a.hits, a.n, b.hits, b.n)});
        }
    }
    out.encodings = std::move(inOrder);
    out.preferred = std::move(preferred);
    return out;
}

std::map<std::string, std::size_t> preferences(std::span<const EncodingComparison> people) {
    std::map<std::string, std::size_t> out;
    for (const auto& person : people) {
        for (const auto& encoding : person.encodings) out.try_emplace(encoding.encoding, 0);
        if (!person.preferred.empty()) ++out[person.preferred];
    }
    return out;
}

std::size_t williamsRows(std::size_t encodings) noexcept {
    if (encodings < 2) return 1;
    return encodings % 2 == 0 ? encodings : 2 * encodings;
}

std::vector<std::size_t> williamsOrder(std::size_t encodings, std::size_t enrolled) {
    if (encodings == 0) return {};
    const std::size_t row = enrolled % williamsRows(encodings);
    std::vector<std::size_t> order;
    // 0, 1, n - 1, 2, n - 2, ... with the row's number added; of an odd number the same rows again, backwards.
    for (std::size_t i = 0; i < encodings; ++i) {
        const std::size_t step = i % 2 == 1 ? (i + 1) / 2 : (encodings - i / 2) % encodings;
        order.push_back((step + row) % encodings);
    }
    if (row >= encodings) order = {order.rbegin(), order.rend()};
    return order;
}

}  // namespace tacto
