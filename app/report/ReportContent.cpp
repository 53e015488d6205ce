#include "app/report/ReportContent.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "app/report/CertificatePages.h"
#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/ReportBasis.h"
#include "app/report/ShownText.h"
#include "app/report/TableContent.h"
#include "core/session/Origin.h"

namespace tacto {
namespace {

QString originOf(const ReportDevice& device) {
    return !device.origin.isEmpty() ? device.origin : device.simulated ? origin::kSimulated : origin::kHardware;
}

/// True if a device of one of these roles was simulated. If there is no such device, true if the session is simulated,
/// as in a prediction.
bool isSimulated(const ReportModel& model, std::initializer_list<Role> roles) {
    bool any = false, found = false;
    for (const auto& device : model.devices) {
        if (std::none_of(roles.begin(), roles.end(), [&](Role role) { return device.is(role); })) continue;
        found = true;
        any = any || device.simulated;
    }
    return found ? any : model.simulated;
}

/// Each figure is marked separately: an oscilloscope's capture of a stimulator is a measurement even if the fingertip
/// sensor was simulated (hazard H9).
bool isSimulated(const ReportModel& model, const Figure& figure) {
    if (std::holds_alternative<TimelineFigure>(figure.content)) return model.simulated;
    if (std::holds_alternative<ExposureFigure>(figure.content))
        return isSimulated(model, {Role::Stimulator, Role::Massager});
    return isSimulated(model, {Role::Stimulator, Role::Oscilloscope, Role::Massager});
}

/// True if every device is simulated.
bool isAllSimulated(const ReportModel& model) {
    return model.simulated && std::all_of(model.devices.begin(), model.devices.end(),
                                          [](const ReportDevice& device) { return device.simulated; });
}

VerdictBlock verdictOf(const ReportModel& model) {
    VerdictBlock block;
    block.verdict = model.verdict;
    for (const auto& reason : model.reasons) block.reasons << capitalised(withSigns(reason));
    // H9: nothing passes on altered evidence.
    const bool unproven = !model.damage.isEmpty() && model.verdict == ReportVerdict::Pass;
    if (unproven) block.verdict = ReportVerdict::Indeterminate;
    block.mark = verdictMark(block.verdict);
    switch (block.verdict) {
        case ReportVerdict::Pass:
            block.word = "Pass";
            break;
        case ReportVerdict::Fail:
            block.word = "Fail";
            break;
        case ReportVerdict::Indeterminate:
            block.word = "Indeterminate";
            break;
        case ReportVerdict::Stopped:
            block.word = "Stopped";
            break;
        case ReportVerdict::None:
            block.word = "No verdict";
            if (block.reasons.isEmpty()) block.reasons << "This protocol records; it does not judge.";
            break;
    }
    if (block.reasons.isEmpty()) block.reasons << "The session gives no reason.";
    if (model.simulated) block.word += isAllSimulated(model) ? " – simulated" : " – simulated in part";
    if (!model.damage.isEmpty()) {
        block.word += " – session damaged";
        block.reasons.prepend(unproven ? "This session said that it passed. It is not what was recorded, so nothing "
                                         "is proven by it."
                                       : "This session is not what was recorded.");
    }
    return block;
}

QString titleOf(const ReportModel& model) {
    const QString title = model.title.isEmpty() ? model.protocol : model.title;
    return title.isEmpty() ? QString("Session") : title;
}

QString subtitleOf(const ReportModel& model) {
    QStringList parts;
    QString when = model.started;
    when.replace('T', ' ').replace('Z', " UTC");
    if (!when.isEmpty()) parts << when;
    if (std::isfinite(model.duration_s)) {
        parts << (model.duration_s < 60 ? settingText(std::round(model.duration_s * 10) / 10, "s")
                                        : durationText(model.duration_s));
    }
    const QString line = parts.join("  ·  ");
    return model.purpose.isEmpty() ? line : line.isEmpty() ? model.purpose : model.purpose + '\n' + line;
}

TableBlock devicesTable(const ReportModel& model) {
    TableBlock table;
    table.caption = "Devices";
    table.columns = {{"Role"}, {"Device"}, {"Address"}, {"Serial"}, {"Firmware"}, {"Origin"}};
    const auto orDash = [](const QString& text) { return text.isEmpty() ? QString("–") : text; };
    for (const auto& device : model.devices) {
        table.rows.push_back({capitalised(orDash(device.role)), orDash(device.name), orDash(device.uri),
                              orDash(device.serial), orDash(device.firmware), originOf(device)});
    }
    return table;
}

/// Distinguishes two reports, even if they are of one session that has grown since.
QString reportNumber(const ReportModel& model) {
    return model.session + (model.chainHead.isEmpty() ? QString() : "-" + model.chainHead.left(8));
}

/// Marks on the first page what is simulated, replayed and real.
void addMarks(const ReportModel& model, std::vector<ReportBlock>& blocks) {
    if (model.simulated && model.devices.empty()) {
        blocks.emplace_back(
            ParagraphBlock{"Simulated without a device: its numbers are predicted, none was measured."});
    } else if (!model.marks.isEmpty()) {
        // The certificate itself says which correction was applied before a calibration.
        QStringList marks = model.marks;
        if (isCertificate(model)) marks.removeIf([](const QString& mark) { return mark.contains("not calibrated"); });
        if (!marks.isEmpty()) blocks.emplace_back(ParagraphBlock{marks.join('\n')});
    } else if (model.simulated) {
        blocks.emplace_back(ParagraphBlock{
            "At least one device of this session was simulated. Its numbers say what the software does, not what "
            "hardware or a person would."});
    }
}

void addUsed(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    blocks.emplace_back(captions.heading("What was used"));
    if (model.devices.empty()) {
        blocks.emplace_back(ParagraphBlock{"No device took part in this session.", true});
    } else {
        auto devices = devicesTable(model);
        devices.caption = captions.table(devices.caption);
        blocks.emplace_back(std::move(devices));
    }
    FactsBlock facts;
    if (!model.session.isEmpty()) {
        facts.facts.push_back({"Report number", reportNumber(model)});
        facts.facts.push_back({"Raw data", model.session + ".tacto"});
    }
    for (const auto& setting : model.settings)
        facts.facts.push_back({setting.name, withSigns(setting.value), setting.isHash});
    facts.facts.insert(facts.facts.end(), model.identity.begin(), model.identity.end());
    facts.facts.push_back({"Chain head",
                           model.chainHead.isEmpty() ? QString("none: the session has no rows yet") : model.chainHead,
                           !model.chainHead.isEmpty()});
    blocks.emplace_back(std::move(facts));
}

}  // namespace

TableBlock tableOf(const ResultTable& source, const nlohmann::json& records, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.rows.resize(records.size());
    auto texts = columnTexts(source.columns, records);
    for (std::size_t c = 0; c < texts.size(); ++c) {
        const auto& column = source.columns[c];
        auto& text = texts[c];
        const bool known = std::ranges::any_of(text.cells, [](const QString& cell) { return cell != u"–"; });
        if (!known && !records.empty()) continue;  // omits a column that is empty in every row
        if (column.as == ResultColumn::As::Text) sharePrefix(text.cells);
        auto title = text.header.replace('\n', ' ');
        if (text.right) {
            if (const auto unit = takeUnit(text.cells); !unit.isEmpty()) title += " (" + unit + ")";
            alignPoints(text.cells);
        }
        table.columns.push_back({title, text.right});
        if (column.as == ResultColumn::As::Verdict) {
            for (auto& cell : text.cells) cell.replace(' ', QChar(0x00a0));  // shape and word stay on one line
            if (table.columns.size() == 1) table.naming = 1;
        }
        for (std::size_t r = 0; r < records.size(); ++r)
            table.rows[r] << shownText(text.cells[qsizetype(r)], kShownCell);
    }
    return table;
}

namespace {

/// Lists the facts below each other, without those missing in the record.
TableBlock factsOf(const ResultTable& source, const nlohmann::json& record, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Quantity"}, {"Value"}};
    for (const auto& column : source.columns) {
        if (memberAt(record, column.at).is_null()) continue;
        auto text = columnText(column, nlohmann::json::array({record}));
        table.rows.push_back({text.header.replace('\n', ' '), shownText(text.cells.front(), kShownCell)});
    }
    return table;
}

using Shape = ResultTable::Shape;

/// Adds the limit tables of the results' kind, or its other tables, without those that appear elsewhere in the report.
void addResults(const nlohmann::json& results, bool limitsAlone, Captions& captions, std::vector<ReportBlock>& blocks) {
    const QString partial = memberAt(results, "partial") == true ? " (partial: the run ended early)" : "";
    const auto add = [&](TableBlock block) {
        if (!block.rows.empty() && !block.columns.empty()) blocks.emplace_back(std::move(block));
    };
    for (const auto& table : tablesOf(results)) {
        if (!isInReport(table.shown) || (table.shape == Shape::Limits) != limitsAlone) continue;
        const auto title = QString::fromStdString(table.title) + partial;
        const auto& value = table.at.empty() ? results : memberAt(results, table.at);
        const auto before = blocks.size();
        if (const auto rows = rowsOf(table, results); table.shape == Shape::Rows && !rows.empty())
            add(tableOf(table, rows, captions.table(title)));
        else if (table.shape == Shape::Facts && value.is_object())
            add(factsOf(table, value, captions.table(title)));
        else if (auto beside = acrossOf(table, rows); table.shape == Shape::Across && !beside.columns.isEmpty())
            blocks.emplace_back(shortened(std::move(beside), captions.table(title)));
        else if (auto limits = limitsOf(value); table.shape == Shape::Limits && !limits.rows.empty()) {
            add(closestOf(limits, captions.table("Closest to their limits" + partial)));
            blocks.emplace_back(shortened(std::move(limits), captions.table(title)));
        } else if (table.shape == Shape::Sentences)
            for (const auto& text : sentencesIn(value))
                blocks.emplace_back(ParagraphBlock{capitalised(shownText(text))});
        if (blocks.size() > before && !table.note.empty())
            blocks.emplace_back(ParagraphBlock{QString::fromStdString(table.note), true});
    }
}

void addItems(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    if (model.items.empty()) return;
    blocks.emplace_back(captions.heading(isCertificate(model) ? "How they were found" : "Results"));
    // Readers ask first how close the limits are.
    for (const auto& item : model.items)
        if (const auto* found = std::get_if<ReportResults>(&item)) addResults(found->results, true, captions, blocks);
    for (const auto& item : model.items) {
        if (const auto* figure = std::get_if<ReportFigure>(&item)) {
            blocks.emplace_back(FigureBlock{captions.figure(figure->caption, isSimulated(model, figure->figure)),
                                            figureLegend(figure->figure),
                                            drawFigure(figure->figure, isSimulated(model, figure->figure))});
        } else if (const auto* table = std::get_if<ReportTable>(&item)) {
            if (table->rows.isEmpty()) {
                blocks.emplace_back(ParagraphBlock{captions.table(table->caption) + ": there are no rows.", true});
            } else {
                blocks.emplace_back(tableOf(*table, captions.table(table->caption)));
            }
        } else if (const auto* matrix = std::get_if<ReportMatrix>(&item)) {
            blocks.emplace_back(matrixOf(*matrix, captions.table(matrix->caption)));
        } else if (const auto* found = std::get_if<ReportResults>(&item)) {
            addResults(found->results, false, captions, blocks);
        } else {
            blocks.emplace_back(ParagraphBlock{withSigns(std::get<ReportText>(item).text)});
        }
    }
}

/// Computed values are not measurements and never get such a title (science.md section 12).
void addComputed(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    const bool anyJudged = std::any_of(model.exposure.begin(), model.exposure.end(),
                                       [](const auto& row) { return !row.evaluated() || row.limit > 0; });
    if (!anyJudged) return;  // a session without a stimulator
    blocks.emplace_back(captions.heading("Computed from approved trains"));
    blocks.emplace_back(ParagraphBlock{
        "What the safety check computed for the trains that it approved, worst case over the permitted loads. Over 1 s "
        "and 5 s these are upper bounds: a train counts whole in every window that it may touch. None of it was "
        "measured; captured values are among the results.",
        true});
    const Figure figure{ExposureFigure{model.exposure}, {}};
    blocks.emplace_back(FigureBlock{
        captions.figure("Exposure computed from approved trains, against each limit", isSimulated(model, figure)),
        figureLegend(figure), drawFigure(figure, isSimulated(model, figure))});
}

}  // namespace

ReportContent contentOf(const ReportModel& whole) {
    const ReportModel model = shownModel(whole);
    const bool certified = isCertificate(model);
    ReportContent content;
    content.simulated = model.simulated;
    content.documentTitle = certified ? certificateTitle(model) : titleOf(model);
    content.damaged = !model.damage.isEmpty();
    content.alarming = content.damaged || (certified && model.simulated);
    const QString head = certified ? "Calibration certificate " + shownText(reportNumber(whole), kShownHead)
                                   : "Tactoscope  ·  " + shownText(titleOf(whole), kShownHead);
    content.header = QString(content.damaged    ? "DAMAGED: this session is not what was recorded  ·  "
                             : content.alarming ? "SIMULATED: no device was calibrated  ·  "
                                                : "") +
                     head +
                     (content.alarming && certified ? ""
                      : isAllSimulated(model)       ? "  ·  simulated"
                      : model.simulated             ? "  ·  simulated in part"
                                                    : "");
    content.footer = "Session " + (model.session.isEmpty() ? QString("–") : shownText(whole.session, kShownHead)) +
                     "  ·  chain head " + (model.chainHead.isEmpty() ? QString("–") : model.chainHead.left(12) + "…");

    Captions captions(isAllSimulated(model));
    auto& blocks = content.blocks;
    blocks.emplace_back(
        TitleBlock{content.documentTitle,
                   certified ? "Certificate " + reportNumber(model) + '\n' + model.purpose : subtitleOf(model)});
    if (certified) {
        addCertificateItem(model, captions, blocks);
        blocks.emplace_back(captions.heading("Statement of conformity"));
    } else if (const auto why = whyNoCertificate(model)) {
        blocks.emplace_back(ParagraphBlock{"No calibration certificate: " + *why + "."});
    }
    blocks.emplace_back(verdictOf(model));
    if (certified) addCertificateConformity(model, captions, blocks);
    if (content.damaged) {
        blocks.emplace_back(captions.heading("DAMAGED"));
        blocks.emplace_back(
            ParagraphBlock{"“tactoscope-cli verify” finds that this session was altered or is "
                           "incomplete. Do not rely on what follows. It finds:\n" +
                           model.damage.join('\n')});
    }
    addMarks(model, blocks);
    addFrontPage(model, captions, blocks);
    if (certified) addCertificateResults(model, captions, blocks);
    addItems(model, captions, blocks);
    addComputed(model, captions, blocks);
    blocks.emplace_back(captions.heading("Events"));
    if (model.events.empty()) {
        blocks.emplace_back(ParagraphBlock{"No fault, refusal or stop was recorded.", true});
    } else {
        blocks.emplace_back(eventsTable(model, captions.table("Faults, refusals, stops and remarks")));
    }
    addUsed(model, captions, blocks);
    if (!model.reproduce.isEmpty()) {
        blocks.emplace_back(captions.heading("How to reproduce"));
        blocks.emplace_back(CodeBlock{model.reproduce});
    }
    blocks.emplace_back(ParagraphBlock{
        "Tactoscope is a research bench, not a medical device. The chain head identifies the session's contents: "
        "“tactoscope-cli verify” must print the same one.",
        true});
    if (certified) blocks.emplace_back(ParagraphBlock{"End of calibration certificate " + reportNumber(model) + "."});
    return content;
}

}  // namespace tacto
