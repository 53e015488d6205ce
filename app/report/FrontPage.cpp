#include "app/report/FrontPage.h"

#include <algorithm>

#include "app/report/CertificatePages.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

constexpr auto kNotRecorded = "not recorded";

QString orNotRecorded(const QString& text) { return text.isEmpty() ? QString(kNotRecorded) : text; }

bool has(const ReportModel& model, Role role) {
    return std::any_of(model.devices.begin(), model.devices.end(),
                       [role](const ReportDevice& device) { return device.is(role); });
}

TableBlock instrumentsTable(const ReportModel& model, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Instrument"}, {"Channel"}, {"Accuracy"}, {"Stated by"}};
    for (const auto& each : model.basis.instruments)
        table.rows.push_back({capitalised(each.name), each.channel, each.states, each.statedBy});
    return table;
}

FactsBlock factsOf(const ReportModel& model) {
    FactsBlock block;
    block.oneColumn = true;
    const auto& basis = model.basis;
    const bool certified = isCertificate(model);  // its first page has said some of it
    block.facts = certified ? certificateMethod(model) : basis.rule;
    block.facts.insert(block.facts.end(), basis.restsOn.begin(), basis.restsOn.end());
    if (has(model, Role::Oscilloscope)) {
        block.facts.push_back(
            {"Certificate", basis.certificate.isEmpty() ? QString("none of the oscilloscope") : basis.certificate});
    }
    QStringList open = basis.notEvaluated;
    // A run that broke off, or that approved nothing, has no exposure: said here, and no section is left empty for it.
    if (has(model, Role::Stimulator) && model.exposure.empty())
        open << "exposure: this session holds no approved train";
    block.facts.push_back(
        {"Not evaluated", open.isEmpty() ? QString("nothing, as far as this session says") : open.join(";\n") + "."});
    if (!certified) block.facts.push_back({"Sample", orNotRecorded(basis.sample)});
    if (!basis.note.isEmpty()) block.facts.push_back({"Note, added after the recording", basis.note});
    if (!basis.tags.isEmpty()) block.facts.push_back({"Tags, added after the recording", basis.tags});
    if (!certified) block.facts.push_back({"Ambient conditions", orNotRecorded(basis.ambient)});
    return block;
}

}  // namespace

void addFrontPage(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    blocks.emplace_back(captions.heading(isCertificate(model) ? "Method, traceability and what the values rest on"
                                                              : "How it was decided, and what that rests on"));
    blocks.emplace_back(factsOf(model));
    if (!model.basis.instruments.empty())
        blocks.emplace_back(instrumentsTable(model, captions.table("Instruments, and what their accuracy rests on")));
    const auto& basis = model.basis;
    blocks.emplace_back(
        SignaturesBlock{{"Operator", "Reviewer"}, {"Name", "Date", "Signature"}, {basis.operatorName, basis.reviewer}});
}

}  // namespace tacto
