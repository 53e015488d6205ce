#include "app/report/ShownText.h"

namespace tacto {
namespace {

void shorten(QString& text) { text = shownText(text); }

void shorten(QStringList& texts) {
    for (auto& text : texts) shorten(text);
}

void shortenEach(std::initializer_list<QString*> texts) {
    for (auto* text : texts) shorten(*text);
}

void shortenCells(std::initializer_list<QString*> texts) {
    for (auto* text : texts) *text = shownText(*text, kShownCell);
}

void shorten(ReportItem& item) {
    if (auto* figure = std::get_if<ReportFigure>(&item)) {
        shortenEach({&figure->caption, &figure->figure.note});
    } else if (auto* table = std::get_if<ReportTable>(&item)) {
        shorten(table->caption);
    } else if (auto* matrix = std::get_if<ReportMatrix>(&item)) {
        shorten(matrix->caption);
    } else if (auto* said = std::get_if<ReportText>(&item)) {
        shorten(said->text);
    }
}

}  // namespace

QString shownText(const QString& text, qsizetype most) {
    if (text.size() <= most) return text;
    if (text[most - 1].isHighSurrogate()) --most;
    return QString("%1… (%2 more characters in the session)").arg(text.left(most)).arg(text.size() - most);
}

ReportModel shownModel(ReportModel model) {
    shortenEach({&model.title, &model.purpose, &model.protocol, &model.session, &model.started, &model.chainHead});
    for (auto* texts : {&model.reasons, &model.marks, &model.damage, &model.reproduce}) shorten(*texts);
    for (auto& device : model.devices)
        shortenCells({&device.role, &device.name, &device.uri, &device.serial, &device.firmware, &device.origin});
    auto& basis = model.basis;
    shorten(basis.notEvaluated);
    shortenCells({&basis.certificate, &basis.operatorName, &basis.sample, &basis.reviewer, &basis.ambient, &basis.note,
                  &basis.tags});
    for (auto& each : basis.instruments) shortenCells({&each.name, &each.channel, &each.states, &each.statedBy});
    for (auto* facts : {&model.settings, &model.identity, &basis.rule, &basis.restsOn}) {
        for (auto& fact : *facts) shortenEach({&fact.name, &fact.value});
    }
    for (auto& item : model.items) shorten(item);
    for (auto& row : model.exposure) shortenCells({&row.name, &row.unit, &row.source, &row.reason});
    for (auto& event : model.events) shortenCells({&event.kind, &event.text});
    return model;
}

QString capitalised(QString text) {
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    return text;
}

QString axisTitle(const QString& title, const QString& unit) {
    return unit.isEmpty() ? capitalised(title) : QString("%1 (%2)").arg(capitalised(title), unit);
}

}  // namespace tacto
