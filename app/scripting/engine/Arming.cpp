#include "app/scripting/engine/Arming.h"

#include "core/electrode/Load.h"

namespace tacto {

Result<ArmRequest> confirmedArming(ScriptSession& session, const std::string& load) {
    Bench& bench = session.bench();
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    ArmRequest request;
    request.load = load;
    if (!bench.outputIsReal()) {  // nothing leaves the computer
        request.operatorConfirmed = true;
        request.declaredLoadConfirmed = true;
        return request;
    }
    OperatorQuestion question;
    question.name = kConfirmArming;
    question.confirms = bench.armingText(*parsed);
    question.text = "Arm " + question.confirms + "?";
    question.word = bench.mode() == OutputMode::Person      ? "person"
                    : bench.devices().stimulator != nullptr ? "bench load"
                                                            : "massager";
    if (!session.hasConfirmed(question.confirms)) {
        // Without the operator's confirmation the run ends, even if the script catches the error.
        auto answer = session.ask(question);
        if (!answer) return session.endWith(answer.error());
        if (*answer != nlohmann::json(true)) {
            return session.endWith(
                {ErrorCode::Stopped, fmt::format("\"{}\" was not confirmed. Nothing was armed.", question.text)});
        }
        session.noteConfirmed(question.confirms);
    }
    request.operatorConfirmed = true;
    request.declaredLoadConfirmed = true;  // the text names the connected load and says that it is not measured
    request.confirmed = question.confirms;
    return request;
}

Result<void> armConfirmed(ScriptSession& session, const std::string& load) {
    const auto request = confirmedArming(session, load);
    if (!request) return failure(request);
    return session.bench().arm(*request);
}

}  // namespace tacto
