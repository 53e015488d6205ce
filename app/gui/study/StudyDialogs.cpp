#include "app/gui/study/StudyDialogs.h"

#include <QComboBox>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <algorithm>

#include "app/gui/study/PassphraseDialog.h"
#include "app/gui/study/StudyForm.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/FieldForm.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto::gui {

namespace {

constexpr int kDialogWide = 480, kDialogHigh = 580, kMinScrolled = 120;
constexpr int kMaxEnrolSeed = 1'000'000;

QString tr(const char* text) { return QObject::tr(text); }

/// A dialog with heading, explanation, questions, a line for errors, and Cancel next to the button that acts.
class StudyDialog final : public QDialog {
public:
    using Act = std::function<Result<void>(Study& study)>;

    /// The object names are `name` + "Dialog" and `name` + "Trouble". If `explains` is empty there is no explanation.
    StudyDialog(OpenStudy& study, const QString& name, const QString& title, const QString& explains, QWidget* parent)
        : QDialog(parent),
          study_(study),
          column_(new QVBoxLayout(this)),
          trouble_(new TroubleLine(name + "Trouble", this)) {
        setObjectName(name + "Dialog");
        setWindowTitle(title);
        setMinimumWidth(scaledPx(kDialogWide));
        column_->addWidget(heading(title, this));
        if (!explains.isEmpty()) column_->addWidget(explanation(explains, this));
    }
    /// The column for the questions, filled before finish().
    [[nodiscard]] QVBoxLayout& column() { return *column_; }
    QLabel* say(const QString& what, const char* name) {
        auto* label = makeLabel(what, {.name = name, .wraps = true, .plain = true, .selectable = true}, this);
        column_->addWidget(label);
        return label;
    }
    FieldForm* ask(const std::vector<FormField>& fields, FieldForm::Labels labels = FieldForm::Labels::Above) {
        form_ = new FieldForm(this, labels);
        form_->setMissingSaidOnceLeft();
        form_->show(fields);
        connect(form_, &FieldForm::edited, this, &StudyDialog::judge);
        column_->addWidget(form_);
        return form_;
    }
    /// Adds `page` in a scroll area, for content that may be higher than the screen.
    void scroll(QWidget* page) {
        auto* scrolling = new ScrollingPage(this);
        scrolling->hold(page);
        scrolling->setMinimumHeight(scaledPx(kMinScrolled));
        column_->addWidget(scrolling, 1);
        scrolls_ = true;
        resize(scaledPx(kDialogWide) + 80, kDialogHigh);
    }
    /// Adds the error line and the buttons, none of them default. `nothing`: the text shown if the study is closed. If
    /// `act` succeeds, the dialog announces the change and closes.
    void finish(QPushButton* button, const char* name, const QString& nothing, Act act) {
        if (!scrolls_) column_->addStretch(1);  // keeps the questions together below the heading
        column_->addWidget(trouble_);
        auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
        buttons->addButton(button, QDialogButtonBox::ActionRole);
        button->setObjectName(name);
        for (auto* each : {cancel_ = buttons->button(QDialogButtonBox::Cancel), button}) each->setAutoDefault(false);
        column_->addWidget(buttons);
        connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
        act_ = std::move(act);
        button_ = button;
        connect(button, &QPushButton::clicked, this, [this, nothing] { take(nothing); });
        growWithContent(*this);
    }
    /// `byReturn`: the button is the default.
    void finish(const QString& button, const char* name, const QString& nothing, Act act, bool byReturn = false) {
        auto* primary = new QPushButton(button, this);
        makePrimary(*primary);
        finish(primary, name, nothing, std::move(act));
        primary->setDefault(byReturn);
    }
    [[nodiscard]] OpenStudy& opened() const { return study_; }
    /// Tries the change whenever an answer changes, and disables the button, with the reason beside it, while the study
    /// would refuse it. Called after finish(); `act` must do nothing but change the study before that succeeds.
    void judgeAsTyped() {
        judged_ = true;
        connect(&study_, &OpenStudy::changed, this, &StudyDialog::judge);
        judge();
    }
    void judge() {
        QString why = judged_ ? wrong() : QString();
        if (auto* study = study_.study(); judged_ && why.isEmpty() && study != nullptr) {
            if (const auto done = study->would(act_); !done) why = sentence(done.error());
        }
        trouble_->say(why);
        if (judged_) button_->setEnabled(why.isEmpty());
    }
    /// Returns the study if it is open; null otherwise.
    [[nodiscard]] const Study* study() const { return study_.study(); }
    /// Keeps the dialog open after `act` succeeds.
    void stayOpen() { stays_ = true; }
    void nameCancel(const QString& word) { cancel_->setText(word); }

private:
    [[nodiscard]] QString wrong() const { return form_ == nullptr ? QString() : form_->wrong(); }
    void take(const QString& nothing) {
        if (const auto why = wrong(); !why.isEmpty()) return trouble_->say(why);
        auto* study = study_.study();
        if (study == nullptr) return trouble_->say(tr("The study is not open any more. %1").arg(nothing));
        if (const auto done = act_(*study); !done) return trouble_->say(sentence(done.error()));
        study_.disconnect(this);  // what is done is not judged again
        study_.noteChange();
        if (!stays_) accept();
    }
    OpenStudy& study_;
    QVBoxLayout* column_;
    TroubleLine* trouble_;
    FieldForm* form_ = nullptr;
    QPushButton* cancel_ = nullptr;
    QPushButton* button_ = nullptr;  // acts
    Act act_;
    bool judged_ = false;
    bool scrolls_ = false;
    bool stays_ = false;
};

/// Returns "3  severe": a score with its word from ScoreWords.h.
QString scoreChoice(std::span<const char* const> words, int score, int from = 1) {
    return QString("%1  %2").arg(score).arg(QCoreApplication::translate("Score", words[std::size_t(score - from)]));
}

/// A field for a score that must be chosen; `words` describe the scores. `needed`: what to say if none is chosen.
FormField scoreField(const char* name, const QString& label, std::span<const char* const> words, const QString& needed,
                     int from = 1) {
    std::vector<std::pair<QString, QString>> choices{{"", tr("to be chosen")}};
    for (int score = from; score < from + int(words.size()); ++score)
        choices.emplace_back(QString::number(score), scoreChoice(words, score, from));
    auto field = choiceField(name, label, choices, {});
    field.parameter.needed = needed.toStdString();
    return field;
}

constexpr const char* kNoSession = "none";

/// The field "session" with all sessions of a study; selects the last one of `code`, or else the last of all.
FormField sessionField(const Study* study, const QString& code, bool mayBeNone = false) {
    std::vector<std::pair<QString, QString>> choices;
    QString chosen, last;
    for (const auto& each : study == nullptr ? std::vector<StudySession>() : study->sessions()) {
        const auto begun = QDateTime::fromSecsSinceEpoch(each.parts.front().begun.time_since_epoch().count());
        last = qtext(each.id);
        choices.emplace_back(last, tr("%1, session %2, %3")
                                       .arg(each.code.empty() ? tr("withdrawn") : qtext(each.code))
                                       .arg(each.number)
                                       .arg(begun.toString("yyyy-MM-dd HH:mm")));
        if (!code.isEmpty() && qtext(each.code) == code) chosen = last;
    }
    if (choices.empty() && !mayBeNone) choices.emplace_back("", tr("no session was begun"));
    if (chosen.isEmpty() && code.isEmpty()) chosen = last;
    if (chosen.isEmpty() && !choices.empty() && !choices.front().first.isEmpty())
        choices.insert(choices.begin(), {"", tr("to be chosen: %1 has no session").arg(code)});
    if (mayBeNone) choices.emplace_back(kNoSession, tr("outside sessions"));
    auto field = choiceField("session", tr("Session"), choices, {});
    if (chosen.isEmpty() && choices.size() == 1) chosen = choices.front().first;
    field.parameter.value = chosen.toStdString();
    field.parameter.needed = tr("it belongs to nothing").toStdString();
    return field;
}

FormField aboutField(const char* name, const QString& label, std::span<const std::string_view> words) {
    std::vector<std::pair<QString, QString>> choices{{"", tr("not given")}};
    for (const auto word : words) choices.emplace_back(qtext(word), qtext(word));
    return choiceField(name, label, choices,
                       tr("Fill in only if the approval requires it. It is sealed, and exported only on request."));
}

/// Side effects since the session, each with its relation to the session.
struct SideEffectRows {
    struct Item {
        QComboBox* severity;
        QComboBox* relation;
    };
    QWidget* grid = new QWidget;
    std::vector<Item> items{};  ///< in the order of kSideEffects

    SideEffectRows() {
        auto* cells = layoutIn<QGridLayout>(*grid, -1, {});
        cells->setColumnStretch(0, 1);
        int row = 0, column = 0;
        for (const auto& title : {tr("Since then"), tr("Severity"), tr("Related to it")}) {
            cells->addWidget(strongLabel(title, grid), row, column++);
        }
        for (const auto& each : kSideEffects) {
            const auto text = QCoreApplication::translate("SideEffect", each.text);
            cells->addWidget(new QLabel(text, grid), ++row, 0);
            const auto box = [&](std::span<const char* const> words, const char* part, const QString& none, int at) {
                auto* made = new QComboBox(grid);
                nameWidget(*made, QString("%1-%2").arg(each.key, part), QString("%1, %2").arg(text, part));
                made->addItem(none, 0);
                for (int score = 1; score <= int(words.size()); ++score)
                    made->addItem(scoreChoice(words, score), score);
                cells->addWidget(made, row, at);
                return made;
            };
            const Item item{box(kSideEffectSeverities, "severity", tr("not noticed"), 1),
                            box(kRelations, "relation", QString("–"), 2)};
            item.relation->setEnabled(false);
            QObject::connect(item.severity, &QComboBox::currentIndexChanged, item.relation, [item](int index) {
                item.relation->setEnabled(index > 0);
                if (index == 0) item.relation->setCurrentIndex(0);
            });
            items.push_back(item);
        }
    }
};

}  // namespace

QDialog* enrolDialog(OpenStudy& study, std::function<void(const QString& code)> consentWanted, QWidget* parent) {
    auto* asks = new StudyDialog(study, "enrol", tr("Enrol a participant"),
                                 tr("A participant is known here by a code alone. Never write a name, a birth date or "
                                    "a hospital number."),
                                 parent);
    std::vector<std::pair<QString, QString>> groups;
    for (const auto& [word, group] : kParticipantGroups) groups.emplace_back(qtext(word), qtext(word));
    auto age = aboutField("enrolAge", tr("&Age in years"), {});
    age.parameter.type = ParameterType::Text;
    age.hint = tr("not given");
    auto* form = asks->ask(
        {choiceField("enrolWho", tr("&Who"), {{"person", tr("a person")}, {"virtual", tr("a virtual participant")}},
                     tr("A virtual participant answers by itself.")),
         wholeField("enrolSeed", tr("&Seed"), 1, kMaxEnrolSeed, 1,
                    tr("The same seed is the same virtual participant.")),
         choiceField("enrolGroup", tr("&Group"), groups, {}),
         textField("enrolCode", tr("&Code"), {},
                   tr("Type a code only if it was given elsewhere. Its last character is a check character."),
                   tr("the program draws a new code")),
         age, aboutField("enrolSex", tr("Se&x"), kSexes),
         aboutField("enrolHandedness", tr("&Handedness"), kHandednesses)},
        FieldForm::Labels::Beside);
    const auto isVirtual = [form] { return form->text("enrolWho") == "virtual"; };
    const auto judge = [form, isVirtual] {
        form->setRowVisible("enrolSeed", isVirtual());
        for (const char* ofPerson : {"enrolAge", "enrolSex", "enrolHandedness"})
            form->setRowVisible(ofPerson, !isVirtual());
    };
    QObject::connect(form, &FieldForm::edited, form, judge);
    judge();
    auto* code = asks->say({}, "enrolledCode");
    code->setAlignment(Qt::AlignCenter);
    setTextSize(*code, TextSize::Display);
    auto* next = asks->say({}, "afterEnrolling");
    for (auto* label : {code, next}) label->hide();
    asks->stayOpen();
    asks->finish(
        tr("Enrol"), "enrolNow", tr("No participant was enrolled."),
        [=, wanted = std::move(consentWanted)](Study& into) -> Result<void> {
            if (!code->text().isEmpty()) {
                asks->accept();
                wanted(code->text());
                return {};
            }
            Participant participant;
            participant.code = form->text("enrolCode").toStdString();
            participant.group =
                valueFor(kParticipantGroups, form->text("enrolGroup").toStdString()).value_or(ParticipantGroup());
            if (isVirtual()) {
                const auto read = form->read();
                if (!read) return failure(read);
                participant.virtualSeed = form->text("enrolSeed").toULongLong();
            } else {
                participant.age = form->text("enrolAge").toStdString();
                participant.sex = form->text("enrolSex").toStdString();
                participant.handedness = form->text("enrolHandedness").toStdString();
            }
            const auto enrolled = into.enrol(std::move(participant));
            if (!enrolled) return failure(enrolled);
            form->hide();
            asks->findChild<QPushButton*>("enrolNow")->setText(tr("Note the consent…"));
            code->setText(qtext(enrolled->code));
            next->setText(
                enrolled->virtualSeed
                    ? tr("Enrolled. The consent to the form in force comes next, as for everyone.")
                    : tr("Enrolled. Give the person this code on paper; at each session their own screen shows "
                         "it. Keep it apart from their name. Their consent comes next."));
            for (auto* label : {code, next}) label->show();
            asks->nameCancel(tr("Close"));
            asks->adjustSize();
            return {};
        },
        true);
    asks->judgeAsTyped();
    return asks;
}

QDialog* consentDialog(OpenStudy& study, const QString& code, QWidget* parent) {
    auto* asks = new StudyDialog(
        study, "consent", tr("Consent of %1").arg(code),
        tr("The signed form stays on paper, apart from the code. What you enter here is sealed."), parent);
    const auto* open = asks->study();
    auto date = textField("date", tr("Day on which it was signed"),
                          open == nullptr ? QString() : qtext(dateText(open->today())), tr("No later than today."));
    date.parameter.type = ParameterType::Date;
    std::vector<FormField> fields{
        textField("version", tr("Version of the form that was signed"),
                  open == nullptr ? QString() : qtext(open->settings().consentVersion),
                  tr("Sessions need consent to the version in force.")),
        date,
        textField("by", tr("Investigator’s initials"), {}, tr("The investigator’s initials, not the participant’s."))};
    for (auto& field : fields) field.parameter.needed = tr("no session can begin").toStdString();
    auto* form = asks->ask(fields);
    if (auto* by = form->findChild<QLineEdit*>("by"); by != nullptr) by->setFocus();  // the others are filled in
    const auto act = [=](Study& into) -> Result<void> {
        return into.consent(
            code.toStdString(),
            {form->text("version").toStdString(),
             parseDate(form->text("date").toStdString()).value_or(CalibrationDate()), form->text("by").toStdString()});
    };
    asks->finish(tr("Note the consent"), "noteConsent", tr("Nothing was noted."), act, true);
    asks->judgeAsTyped();
    return asks;
}

QDialog* endPartDialog(OpenStudy& study, EndOfPart how, const QString& code, QWidget* parent) {
    const bool withdraws = how == EndOfPart::Withdraw;
    auto* asks = new StudyDialog(study, withdraws ? "withdraw" : "leave",
                                 (withdraws ? tr("%1 withdraws") : tr("%1 leaves the study")).arg(code), {}, parent);
    FieldForm* reason = nullptr;
    auto* end = new ConfirmButton(withdraws ? tr("Destroy the key") : tr("Leave the study"), asks);
    if (withdraws) {
        asks->say(tr("The key to everything that %1 did and answered is destroyed. The data can never be opened "
                     "again. The study keeps only that a participant withdrew, when, after how many sessions, and "
                     "adverse events.")
                      .arg(code),
                  "withdrawWhat");
        asks->say(tr("This program cannot reach copies of the key file, backups, and spare blocks of a solid-state "
                     "disk: they still open the data for anyone with the passphrase. Delete the copies by hand."),
                  "withdrawCopies");
        QStringList places;
        for (const auto& one : asks->study() == nullptr ? std::vector<StudyExport>() : asks->study()->exports())
            places << "• " + qtext(one.place);
        asks->say(places.isEmpty() ? tr("Nothing was exported from this study.")
                                   : tr("Exported files stay where they were saved. Delete them by hand:") + '\n' +
                                         places.join('\n'),
                  "withdrawExports");
        auto* form = asks->ask(
            {textField("withdrawCode", tr("Type the &code"), {}, tr("The participant’s code, typed once more."), code)},
            FieldForm::Labels::Beside);
        const auto judge = [=] { end->setEnabled(form->text("withdrawCode").compare(code, Qt::CaseInsensitive) == 0); };
        QObject::connect(form, &FieldForm::edited, end, judge);
        judge();
    } else {
        asks->say(tr("%1 takes part in no further session. The collected data stay, and are part of results and "
                     "exports. If they want their data destroyed, they withdraw instead.")
                      .arg(code),
                  "leaveWhat");
        reason = asks->ask({textField("leaveReason", tr("&Reason"), {},
                                      tr("As far as they say one; never a name. It is sealed."), tr("not known"))});
    }
    asks->finish(end, "endPart", tr("Nothing was changed."), [=](Study& into) -> Result<void> {
        return withdraws ? into.withdraw(code.toStdString())
                         : into.leave(code.toStdString(), reason->text("leaveReason").toStdString());
    });
    if (!withdraws) asks->judgeAsTyped();
    return asks;
}

QDialog* adverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent) {
    auto* asks = new StudyDialog(study, "adverseEvent", tr("An adverse event"),
                                 tr("The event is sealed under the study’s key, goes into the committee’s report and "
                                    "outlasts a withdrawal. Never write a name."),
                                 parent);
    const auto needed = tr("the committee cannot judge it");
    auto what = textField("what", tr("What happened"), {}, {});
    what.parameter.needed = needed.toStdString();
    std::vector<std::pair<QString, QString>> expected;
    for (const auto& [word, each] : kExpectedness) expected.emplace_back(qtext(word), qtext(word));
    auto* form = asks->ask(
        {sessionField(asks->study(), code, true), what,
         scoreField("severity", tr("Severity"), kEventSeverities, needed),
         scoreField("relation", tr("Relation to the stimulation"), kRelations, needed),
         tickField("serious", tr("Serious"), false,
                   tr("No session and no block begins until the study is released by name.")),
         choiceField("expected", tr("Among the approved risks"), expected, {}),
         dayField("onset", tr("Began on"), {}, tr("not known")), dayField("ended", tr("Ended on"), {}, tr("not ended")),
         textField("action", tr("What was done"), {}, {}), textField("outcome", tr("What became of it"), {}, {}),
         tickField("reported", tr("Reported to the committee"), false)});
    asks->scroll(form);
    asks->finish(tr("Note the event"), "noteEvent", tr("Nothing was noted."), [=](Study& into) -> Result<void> {
        AdverseEvent event;
        event.what = form->text("what").toStdString();
        event.severity = form->text("severity").toInt();
        event.relation = form->text("relation").toInt();
        event.serious = form->text("serious") == "true";
        event.expected = valueFor(kExpectedness, form->text("expected").toStdString()).value_or(Expectedness());
        event.onset = form->text("onset").toStdString();
        event.ended = form->text("ended").toStdString();
        event.action = form->text("action").toStdString();
        event.outcome = form->text("outcome").toStdString();
        event.reported = form->text("reported") == "true";
        const auto session = form->text("session");
        return into.adverseEvent(session == kNoSession ? std::string() : session.toStdString(), event);
    });
    asks->judgeAsTyped();
    return asks;
}

QDialog* releaseDialog(OpenStudy& study, QWidget* parent) {
    auto* asks = new StudyDialog(study, "release", tr("Release the study"),
                                 tr("A serious adverse event holds the study. Who is responsible for it decides, by "
                                    "name, that sessions may begin again. It stands in the committee’s report."),
                                 parent);
    std::vector<std::pair<QString, QString>> held;
    const auto events = asks->study() == nullptr ? Result<std::vector<std::pair<std::string, AdverseEvent>>>({})
                                                 : asks->study()->adverseEvents();
    for (std::size_t i = 0; events && i < events->size(); ++i) {
        const auto& event = (*events)[i].second;
        if (event.serious && event.releasedBy.empty())
            held.emplace_back(QString::number(i + 1), QString("%1  %2").arg(i + 1).arg(qtext(event.what)));
    }
    if (held.empty()) held.emplace_back("0", tr("none holds the study"));
    auto by = textField("by", tr("Released by"), {}, tr("The name of who decides, not a participant’s."));
    by.parameter.needed = tr("a release has a name").toStdString();
    auto* form = asks->ask({choiceField("event", tr("After the event"), held, {}), by,
                            textField("reason", tr("Why sessions may begin"), {}, {})});
    asks->finish(tr("Release"), "releaseNow", tr("Nothing was changed."), [=](Study& into) -> Result<void> {
        return into.release(form->text("event").toULongLong(), form->text("by").toStdString(),
                            form->text("reason").toStdString());
    });
    asks->judgeAsTyped();
    return asks;
}

QDialog* noteDialog(OpenStudy& study, const StudyLogKind& kind, QWidget* parent) {
    const auto word = [](const char* text) { return QCoreApplication::translate("StudyLog", text); };
    auto* asks = new StudyDialog(study, "note", word(kind.title), word(kind.explains), parent);
    const auto known = asks->study() != nullptr && kind.lastCounts ? particularsOf(asks->study()->notes()).said
                                                                   : std::map<std::string, std::string>();
    std::vector<FormField> fields;
    for (const auto& each : kind.fields) {
        const auto hint = each.needed ? QString() : tr("unknown");
        const auto found = known.find(each.key);
        const auto value = found == known.end() ? std::string() : found->second;
        auto field = each.is == StudyLogField::Is::Date
                         ? dayField(each.key, word(each.label), word(each.tip), hint)
                         : textField(each.key, word(each.label), qtext(value), word(each.tip), hint);
        if (each.is == StudyLogField::Is::Words) {
            std::vector<std::pair<QString, QString>> choices{{"", each.needed ? tr("to be chosen") : hint}};
            for (const auto* one : each.words) choices.emplace_back(one, word(one));
            field = choiceField(each.key, word(each.label), choices, word(each.tip));
            field.parameter.value = value == kNoWord ? std::string() : value;
        }
        if (each.needed) field.parameter.needed = tr("the note is not whole").toStdString();
        fields.push_back(std::move(field));
    }
    auto* form = asks->ask(fields);
    if (kind.fields.size() > 4) asks->scroll(form);
    asks->finish(tr("Note it"), "noteIt", tr("Nothing was noted."), [=, &kind](Study& into) -> Result<void> {
        StudyNote note{kind.key, {}, {}};
        for (const auto& each : kind.fields) note.said[each.key] = form->text(each.key).trimmed().toStdString();
        return into.note(note);
    });
    asks->judgeAsTyped();
    return asks;
}

QDialog* exportDialog(OpenStudy& study, std::function<void(const BidsWith& with)> wanted, QWidget* parent) {
    auto* asks = new StudyDialog(
        study, "export", tr("Results as BIDS"),
        tr("The export has no names, codes or dates, and only people who consented and had a session. Of few people "
           "each could be told by their age or sex: an age is exported as a range, and nothing that fewer than %1 "
           "share.")
            .arg(kMinAlike),
        parent);
    auto* form = asks->ask({tickField("age", tr("Age, as a range of years"), false), tickField("sex", tr("Sex"), false),
                            tickField("handedness", tr("Handedness"), false)});
    auto* said = asks->say({}, "exportAbout");
    const auto chosen = [form] {
        const auto ticked = [form](const char* name) { return form->text(name) == "true"; };
        return BidsWith{.age = ticked("age"), .sex = ticked("sex"), .handedness = ticked("handedness")};
    };
    const auto judge = [=] {
        const auto shared = asks->study() == nullptr ? SharedAbout() : sharedAbout(*asks->study(), chosen());
        QStringList ages;
        for (const auto& each : shared.people)
            if (!each.age.empty() && !ages.contains(qtext(each.age))) ages << qtext(each.age);
        said->setText((ages.isEmpty() ? QString() : tr("Ages: %1. ").arg(ages.join(", "))) +
                      (shared.withheld.empty() ? QString() : sentence(Error{ErrorCode::Stopped, shared.withheld})));
    };
    QObject::connect(form, &FieldForm::edited, said, judge);
    judge();
    asks->finish(tr("Choose the folder…"), "exportNow", tr("Nothing was exported."),
                 [=, wanted = std::move(wanted)](Study&) -> Result<void> {
                     asks->accept();
                     wanted(chosen());
                     return {};
                 });
    return asks;
}

QDialog* nextDayDialog(OpenStudy& study, const QString& code, QWidget* parent) {
    auto* asks =
        new StudyDialog(study, "nextDay", tr("The day after a session"),
                        tr("Ask the participant on a later day. The answers are sealed; the newest counts. Skin "
                           "that scores 2 or more is noted as an adverse event."),
                        parent);
    const auto needed = tr("the site is not known to be well");
    auto* form = asks->ask({sessionField(asks->study(), code),
                            scoreField("erythema", tr("Redness of the skin"), kSkinScores, needed, 0),
                            scoreField("oedema", tr("Swelling of the skin"), kSkinScores, needed, 0)});
    const SideEffectRows effects;
    auto* inside = new QWidget;
    auto* rows = columnIn(*inside);
    rows->addWidget(form);
    rows->addWidget(effects.grid);
    rows->addStretch();
    asks->scroll(inside);
    asks->finish(tr("Note the answers"), "noteDay", tr("Nothing was noted."),
                 [form, items = effects.items](Study& into) -> Result<void> {
                     NextDay said;
                     said.erythema = form->text("erythema").toInt();
                     said.oedema = form->text("oedema").toInt();
                     for (std::size_t i = 0; i < items.size(); ++i) {
                         const int severity = items[i].severity->currentIndex();
                         const int relation = items[i].relation->currentIndex();
                         if (severity == 0) continue;
                         if (relation == 0)
                             return fail(ErrorCode::InvalidArgument,
                                         "how “{}” is related to the session is missing. 1 to 5 is expected.",
                                         QCoreApplication::translate("SideEffect", kSideEffects[i].text).toStdString());
                         said.sideEffects.push_back({kSideEffects[i].key, severity, relation});
                     }
                     return into.nextDay(form->text("session").toStdString(), said);
                 });
    for (const auto& item : effects.items)
        for (auto* box : {item.severity, item.relation})
            QObject::connect(box, &QComboBox::currentIndexChanged, asks, &StudyDialog::judge);
    asks->judgeAsTyped();
    return asks;
}

QDialog* useEncodingDialog(OpenStudy& study, const UseOfEncoding& use, QWidget* parent) {
    auto* asks = new StudyDialog(study, "useEncoding", tr("Use the better encoding"),
                                 tr("This is a proposal. Sessions follow it once the committee has approved it: both "
                                    "ways lead to an amendment with its own reference."),
                                 parent);
    asks->say(use.found, "useEncodingFound");
    std::vector<std::pair<QString, QString>> ways{
        {"amendment", tr("in this study: “%1” alone, by an amendment").arg(use.encoding)}};
    auto profile = study.profile();
    if (use.encoding == "swapped" && profile.encoding.assignment != Assignment::Swapped) {
        profile.encoding.assignment = Assignment::Swapped;
        ways.emplace_back("profile", tr("in other studies: a new profile with this assignment"));
    }
    auto* form = asks->ask({choiceField("useEncodingWhere", tr("Use it"), ways, {})});
    asks->finish(tr("Go on…"), "useEncodingNow", tr("Nothing was changed."), [=](Study&) -> Result<void> {
        asks->accept();
        form->text("useEncodingWhere") == "profile" ? use.profileWanted(profile) : use.amendWanted();
        return {};
    });
    return asks;
}

QDialog* amendDialog(OpenStudy& study, QWidget* parent, const QString& encoding) {
    constexpr int kAmendWide = 860;
    auto* asks = new StudyDialog(
        study, "amend", tr("An amendment"),
        tr("Change only what the committee has newly approved. Later sessions follow it. The amendment also restates "
           "this program’s protocols and limit sets and the profile in use."),
        parent);
    auto* form = new StudyForm;
    if (const auto* open = asks->study()) form->amend(open->settings());
    if (!encoding.isEmpty()) form->set("encodings", encoding);
    asks->scroll(form);
    asks->resize(scaledPx(kAmendWide), kDialogHigh);
    QObject::connect(form, &StudyForm::edited, asks, &StudyDialog::judge);
    asks->finish(tr("Note the amendment"), "amendNow", tr("Nothing was changed."), [=](Study& into) -> Result<void> {
        auto settings = form->read(asks->opened().profile(), asks->opened().folder());
        if (!settings) return failure(settings);
        const auto reference = settings->approval.reference;
        return into.amend(std::move(*settings), reference);
    });
    asks->judgeAsTyped();
    return asks;
}

QDialog* goBackDialog(OpenStudy& study, QWidget* parent) {
    auto* asks = new StudyDialog(
        study, "goBack", tr("Go back to an older ledger"),
        tr("Put the newest ledger back from your copy if there is one. Going back gives it up for good: it is noted in "
           "the ledger, stands in each report, and no session begins today."),
        parent);
    const auto loss = asks->study() == nullptr
                          ? Result<LedgerLoss>(fail(ErrorCode::NotFound, "the study is not open any more"))
                          : asks->study()->lossOfGoingBack();
    asks->say(loss ? sentence(Error{ErrorCode::Stopped, loss->sentence()}) : sentence(loss.error()), "goBackLoss");
    const auto word = loss ? qtext(loss->word()) : QString();
    PassphraseEdit* passphrase = nullptr;  // null for a rehearsal
    std::vector<FormField> fields;
    if (study.passphrase()) {
        passphrase = new PassphraseEdit(asks);
        passphrase->setObjectName("goBackPassphrase");
        passphrase->setToolTip(tr("The study’s passphrase, typed once more."));
        fields.push_back(ownField(tr("&Passphrase"), passphrase));
    }
    fields.push_back(textField("goBackWord", tr("Type the &word"), {}, tr("The word that names what is lost."), word));
    auto* form = asks->ask(fields, FieldForm::Labels::Beside);
    auto* back = new ConfirmButton(tr("Give up what is lost"), asks);
    const auto judge = [=] {
        back->setEnabled(!word.isEmpty() && form->text("goBackWord") == word &&
                         (passphrase == nullptr || !passphrase->isEmpty()));
    };
    QObject::connect(form, &FieldForm::edited, back, judge);
    if (passphrase != nullptr) QObject::connect(passphrase, &PassphraseEdit::edited, back, judge);
    judge();
    asks->finish(back, "goBack", tr("Nothing was changed."), [=](Study& into) -> Result<void> {
        if (passphrase != nullptr) {
            const auto typed = passphrase->typed();
            const auto& held = asks->opened().passphrase();
            const bool same = held && std::ranges::equal(typed.bytes(), held->bytes());
            passphrase->wipe();
            if (!same)
                return fail(ErrorCode::InvalidArgument,
                            "the passphrase is another than the study’s. Nothing was changed.");
        }
        return into.goBack(word.toStdString());
    });
    return asks;
}

}  // namespace tacto::gui
