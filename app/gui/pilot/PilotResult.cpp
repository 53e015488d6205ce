#include "app/gui/pilot/PilotResult.h"

#include <QFrame>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/ToolRow.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/base/JsonText.h"
#include "core/kinds/ResultKinds.h"
#include "core/study/Participant.h"

namespace tacto::gui {

namespace {

double numberIn(const nlohmann::json& record, const std::string& path) { return numberOr(memberAt(record, path)); }

QString textIn(const nlohmann::json& record, const std::string& path) {
    const auto& at = memberAt(record, path);
    return at.is_string() ? qtext(at.get_ref<const std::string&>()) : QString();
}

/// True if the result comes from a massager, which has strengths as its levels.
bool isMassager(const nlohmann::json& results) {
    return textIn(results, "modality") == qtext(nameOf(Modality::Massager));
}

QString rangeWords(const nlohmann::json& range) {
    const double low = numberIn(range, "min_intensity"), high = numberIn(range, "max_intensity");
    if (std::isfinite(low) && std::isfinite(high))
        return QObject::tr(" between strengths of %1 and %2").arg(decimalText(low, 2), decimalText(high, 2));
    const double low_ma = numberIn(range, "min_ma"), high_ma = numberIn(range, "max_ma");
    if (!std::isfinite(low_ma) || !std::isfinite(high_ma)) return {};
    auto words = QObject::tr(" between %1 and %2 mA").arg(decimalText(low_ma, 1), decimalText(high_ma, 1));
    const double low_v = numberIn(range, "min_v"), high_v = numberIn(range, "max_v");
    const double ohm = numberIn(range, "impedance_ohm");
    if (std::isfinite(low_v) && std::isfinite(high_v) && std::isfinite(ohm))
        words += QObject::tr(", %1 at %2")
                     .arg(qtext(voltageRangeText(Volts(low_v), Volts(high_v))), quantityText(ohm, "ohm", 3));
    return words;
}

/// Returns ", or beyond" if the estimate lies at the edge of the tested range: the true value may lie beyond it.
QString orBeyond(const nlohmann::json& results, const char* atEdge) {
    return memberAt(results, atEdge) == true ? QObject::tr(", or beyond") : QString();
}

/// Names the people and devices behind the figures, unless they are a person and real devices.
QString basisWords(const RunResult& result) {
    if (memberAt(result.outcome.results, "participant").is_object()) {
        switch (basisIn(result.outcome.results)) {
            case SessionBasis::Person:
                break;
            case SessionBasis::PersonSimulated:
                return QObject::tr("Answered by a person, on simulated devices: nothing was felt. ");
            case SessionBasis::Virtual:
                return QObject::tr("Simulated: answered by a virtual participant. ");
        }
    }
    return result.simulated ? QObject::tr("Simulated. ") : QString();
}

/// Returns the person's Weber fraction of strength, from the results of thresholds; empty if it was not measured.
QString weberSentence(const nlohmann::json& thresholds) {
    const auto& weber = memberAt(thresholds, "comparison.amplitude_weber");
    if (!std::isfinite(numberIn(weber, "value"))) return {};
    return QObject::tr("The Weber fraction of strength is %1 (95 % interval %2 to %3)%4.")
        .arg(decimalText(numberIn(weber, "value"), 2), decimalText(numberIn(weber, "low"), 2),
             decimalText(numberIn(weber, "high"), 2), orBeyond(thresholds, "comparison.at_edge"));
}

/// Returns the headline of a session that measured only thresholds.
QString thresholdSentence(const nlohmann::json& results) {
    auto who = textIn(results, "participant.code");
    if (who.isEmpty()) who = QObject::tr("The participant");
    who = qtext(namedWith(basisIn(results), who.toStdString()));
    const bool massager = isMassager(results);
    const auto& estimate = memberAt(results, massager ? "detection.estimate_intensity" : "detection.estimate_ma");
    const double value = numberIn(estimate, "value");
    if (!std::isfinite(value)) return QObject::tr("%1 has no detection threshold up to the highest level.").arg(who);
    auto said = (massager ? QObject::tr("%1 feels a strength of %2 in 4 of 5 trials")
                          : QObject::tr("%1 feels %2 mA in 4 of 5 trials"))
                    .arg(who, decimalText(value, 2));
    const double low = numberIn(estimate, "low"), high = numberIn(estimate, "high");
    if (std::isfinite(low) && std::isfinite(high))
        said += (massager ? QObject::tr(" (95 % interval %1 to %2)") : QObject::tr(" (95 % interval %1 to %2 mA)"))
                    .arg(decimalText(low, 2), decimalText(high, 2));
    said += orBeyond(results, "detection.at_edge");
    const auto range = rangeWords(memberAt(results, "range"));
    said +=
        range.isEmpty() ? QObject::tr("; there is no usable range.") : QObject::tr("; conditions lie") + range + '.';
    if (const auto weber = weberSentence(results); !weber.isEmpty()) said += ' ' + weber;
    return said;
}

}  // namespace

QString resultSentence(const nlohmann::json& results) {
    if (resultTraits(textIn(results, "kind").toStdString()).kind == ResultKind::PilotThresholds)
        return thresholdSentence(results);
    return textIn(results, "headline");
}

PilotResult::PilotResult(QWidget* parent)
    : QWidget(parent),
      head_(new QLabel(this)),
      why_(new QLabel(this)),
      more_(new QLabel(this)),
      matrixTitle_(new QLabel(tr("Stimulus in rows; answer in columns"), this)),
      matrix_(new PageTable("confusion", tr("Confusion matrix"), *this, kPagePad, false)),
      blocks_(new QLabel(this)),
      note_(new QLabel(this)),
      goOn_(pageButton(tr("Go on with the session"), "goOnWithSession",
                       tr("Answered trials are not repeated; the order stays the same."), this)),
      another_(pageButton(tr("New rehearsal"), "anotherRehearsal",
                          tr("In a folder of its own: the same seed gives the same session."), this)),
      back_(pageButton({}, "backFromResult", {}, this)),
      report_(pageButton(tr("Report"), "reportOfResult",
                         tr("Draws the report with this session, to print, save or find it."), this)),
      export_(pageButton(tr("Export…"), "exportOfResult",
                         tr("The rehearsal’s results without codes and dates, as a BIDS dataset in a new folder."),
                         this)),
      place_(pageButton(tr("Open the folder"), "openFolder", {}, this)) {
    setObjectName("pilotResult");
    auto* all = columnIn(*this, 0);
    auto* column = new QVBoxLayout;
    column->setContentsMargins(kPagePad, kPagePad, kPagePad, kPagePad / 2);
    column->setSpacing(8);
    head_->setObjectName("pilotHeadline");
    why_->setObjectName("pilotReason");
    note_->setObjectName("pilotNote");
    for (auto* label : {head_, why_, more_, blocks_, note_}) {
        wrapPlain(*label);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    }
    setTextSize(*head_, TextSize::Large);
    setTone(*more_, Tone::Quiet);
    setTone(*note_, Tone::Quiet);
    setTextSize(*matrixTitle_, TextSize::Body, true);
    addAll(*column, {head_, why_, more_});
    column->addSpacing(8);
    addAll(*column, {matrixTitle_, matrix_, blocks_, note_});
    column->addStretch();
    all->addLayout(column, 1);
    auto* row = addPageFoot(*all, this);
    goOn_->setIcon(icon("run", Ink::Primary));
    makePrimary(*goOn_);
    auto* holder = new QWidget(this);
    auto* lines = new TurningRow({}, holder);
    lines->setContentsMargins(0, 0, 0, 0);
    lines->setSpacing(8);
    const auto add = [lines](std::initializer_list<QWidget*> buttons, int stretch) {
        auto* part = new QHBoxLayout;
        part->setSpacing(8);
        addAll(*part, buttons);
        part->addStretch();
        lines->addLayout(part, stretch);
    };
    add({goOn_, another_, back_}, 0);
    add({report_, export_, place_}, 1);
    row->addWidget(holder, 1);
    connect(goOn_, &QPushButton::clicked, this, &PilotResult::goOnWanted);
    connect(another_, &QPushButton::clicked, this, &PilotResult::anotherWanted);
    connect(back_, &QPushButton::clicked, this, &PilotResult::backWanted);
    connect(report_, &QPushButton::clicked, this, &PilotResult::reportWanted);
    connect(export_, &QPushButton::clicked, this, &PilotResult::exportWanted);
    connect(place_, &QPushButton::clicked, this, [this] { emit folderWanted(folder_); });
}

void PilotResult::say(const QString& what) { note_->setText(note_->text() + '\n' + what); }

void PilotResult::show(const RunResult& result, const QString& folder, bool ofStudy) {
    folder_ = folder;
    const auto& outcome = result.outcome;
    const auto& results = outcome.results;
    const auto said = resultSentence(results);
    head_->setText(!said.isEmpty() ? keptTogether(said)
                   : outcome.error ? tr("The session ended before there was a result.")
                                   : tr("The session has ended."));
    QStringList why;
    if (outcome.error)
        why << withOutput(inThePast(sentence(withoutScriptPlace(qtext(outcome.error->message)))),
                          tr("The output was switched off.")) +
                   tr(" What was answered is on disk.");
    for (const auto& reason : outcome.reasons) {
        const auto text = qtext(reason);
        if (!outcome.error && text != said) why << sentence(text);
    }
    for (const auto& trouble : result.troubles) why << sentence(trouble);
    why_->setText(keptTogether(why.join('\n')));
    why_->setVisible(!why.isEmpty());

    QStringList more;
    const bool untested = numberIn(results, "n") == 0;  // the session ended before its test: nothing to compare
    if (const double p = numberIn(results, "p_chance"); !untested && std::isfinite(p))
        more << (p < 0.001 ? tr("Guessing would reach that in fewer than 1 of 1000 sessions (p < 0.001).")
                           : tr("Guessing would reach that with p = %1.").arg(decimalText(p, 3)));
    if (!untested && std::isfinite(numberIn(results, "it_corrected_bits")))
        more << tr("Information: %1 of 2 bit; what chance adds is taken off.")
                    .arg(qtext(bitsText(correctedBitsFrom(results))));
    if (const double empty = numberIn(results, "catch.n"); std::isfinite(empty) && empty > 0)
        more << tr("Empty trials with a name for an answer: %1 of %2.")
                    .arg(numberIn(results, "catch.false_alarms"))
                    .arg(empty);
    if (const double p = numberIn(results, "fit.p"); std::isfinite(p))
        more << tr("Predicted against answered: G = %1, p = %2.")
                    .arg(decimalText(numberIn(results, "fit.g"), 1), decimalText(p, 2));
    if (const auto weber = weberSentence(memberAt(results, "thresholds")); !weber.isEmpty()) more << weber;
    const auto& motor = memberAt(results, "vibration.reasons");
    if (motor.is_array() && !motor.empty() && motor.front().is_string())
        more << tr("What the massager did: %1").arg(qtext(motor.front().get<std::string>()));
    more_->setText(keptTogether(more.join(' ')));
    more_->setVisible(!more.isEmpty());
    showMatrix(results);

    QStringList blocks;
    const auto& each = memberAt(results, "blocks");
    if (each.is_array()) {
        for (const auto& block : each)
            blocks << tr("block %1: %2 of %3")
                          .arg(numberIn(block, "block"))
                          .arg(numberIn(block, "hits"))
                          .arg(numberIn(block, "n"));
    }
    blocks_->setText(blocks.isEmpty() ? QString() : tr("Right in ") + blocks.join(", ") + '.');
    blocks_->setVisible(!blocks.isEmpty());
    note_->setText(basisWords(result) + (ofStudy ? tr("Study folder: %1.") : tr("Rehearsal folder: %1.")).arg(folder) +
                   (result.markers ? ' ' + qtext(markersSentence(*result.markers)) : QString()) +
                   (result.lsl ? ' ' + qtext(lslSentence(*result.lsl)) : QString()));
    goOn_->hide();
    another_->setVisible(!ofStudy);
    export_->setVisible(!ofStudy);
    makePrimary(*another_);
    ofStudy_ = ofStudy;
    back_->setText(ofStudy ? tr("Back to the study") : tr("Back"));
    makePrimary(*back_, ofStudy);
}

void PilotResult::setMayGoOn(bool may) {
    goOn_->setVisible(may);
    makePrimary(*another_, !may);
    makePrimary(*back_, ofStudy_ && !may);
}

void PilotResult::showMatrix(const nlohmann::json& results) {
    const auto& labels = memberAt(results, "labels");
    const auto& columns = memberAt(results, "columns");
    const auto& counts = memberAt(results, "confusion");
    const bool there = numberIn(results, "n") != 0 && labels.is_array() && columns.is_array() && counts.is_array() &&
                       counts.size() == labels.size();
    matrix_->setVisible(there);
    matrixTitle_->setVisible(there);
    std::vector<ResultColumn> shown;
    auto rows = nlohmann::json::array();
    if (there) shown.push_back({tr("stimulus").toStdString(), "stimulus"});
    const auto wordsOf = [](const nlohmann::json& key) {
        return key.is_string() ? answerWords(key.get<std::string>()) : std::string();
    };
    for (std::size_t i = 0; there && i < columns.size(); ++i) {
        auto title = wordsOf(columns[i]);
        std::ranges::replace(title, ' ', '\n');
        shown.push_back({title, fmt::format("{}", i), ResultColumn::As::Number});
    }
    for (std::size_t r = 0; there && r < labels.size(); ++r) {
        nlohmann::json row{{"stimulus", wordsOf(labels[r])}};
        for (std::size_t i = 0; counts[r].is_array() && i < counts[r].size(); ++i)
            row[fmt::format("{}", i)] = counts[r][i];
        rows.push_back(std::move(row));
    }
    matrix_->show(shown, rows);
    for (int r = 0; r < matrix_->rowCount(); ++r) {
        for (int c = 1; c < matrix_->columnCount(); ++c) {
            if (labels[std::size_t(r)] != columns[std::size_t(c - 1)]) continue;
            auto font = matrix_->font();
            font.setBold(true);
            matrix_->item(r, c)->setFont(font);
        }
    }
}

}  // namespace tacto::gui

#include "moc_PilotResult.cpp"
