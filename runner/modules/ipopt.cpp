// fernlicht-ipopt.so: quadratic programmes by Ipopt's interior point method, which brings linear algebra of others.
#include "metrics/improve/quadratic_programme.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <IpoptConfig.h>
#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

using Ipopt::Index, Ipopt::Number;

constexpr Number no_bound = 2e19; // Ipopt's infinity begins at 1e19

class Programme : public Ipopt::TNLP {
  public:
    Programme(const QuadraticProgramme& programme, QuadraticSolution& solution) : programme_(programme), solution_(solution) {}

    bool get_nlp_info(Index& variables, Index& rows, Index& in_rows, Index& in_hessian, IndexStyleEnum& style) override {
        std::size_t parts = 0;
        for (const LinearRow& row : programme_.rows)
            parts += row.form.size();
        variables = static_cast<Index>(programme_.linear.size());
        rows = static_cast<Index>(programme_.rows.size());
        in_rows = static_cast<Index>(parts);
        in_hessian = static_cast<Index>(programme_.hessian.size());
        style = C_STYLE;
        return true;
    }

    bool get_bounds_info(Index, Number* low, Number* high, Index, Number* row_low, Number* row_high) override {
        const auto bound = [](double value) { return std::clamp(value, -no_bound, no_bound); };
        std::ranges::transform(programme_.low, low, bound);
        std::ranges::transform(programme_.high, high, bound);
        for (const LinearRow& row : programme_.rows) {
            *row_low++ = bound(row.low);
            *row_high++ = bound(row.high);
        }
        return true;
    }

    bool get_starting_point(Index variables, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
        for (std::size_t i = 0; i < static_cast<std::size_t>(variables); ++i)
            x[i] = 0.5 * (std::max(programme_.low[i], std::min(programme_.high[i], 0.0) - 1.0) +
                          std::min(programme_.high[i], std::max(programme_.low[i], 0.0) + 1.0));
        return true;
    }

    bool eval_f(Index, const Number* x, bool, Number& value) override {
        value = 0.0;
        for (const auto& [row, column, factor] : programme_.hessian)
            value += (row == column ? 0.5 : 1.0) * factor * x[row] * x[column];
        for (std::size_t i = 0; i < programme_.linear.size(); ++i)
            value += programme_.linear[i] * x[i];
        return true;
    }

    bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
        std::ranges::copy(programme_.linear, gradient);
        for (const auto& [row, column, factor] : programme_.hessian) {
            gradient[row] += factor * x[column];
            if (row != column)
                gradient[column] += factor * x[row];
        }
        return true;
    }

    bool eval_g(Index, const Number* x, bool, Index, Number* values) override {
        for (const LinearRow& row : programme_.rows) {
            Number sum = 0.0;
            for (const auto& [variable, factor] : row.form)
                sum += factor * x[variable];
            *values++ = sum;
        }
        return true;
    }

    bool eval_jac_g(Index, const Number*, bool, Index, Index, Index* rows, Index* columns, Number* values) override {
        for (std::size_t row = 0; row < programme_.rows.size(); ++row)
            for (const auto& [variable, factor] : programme_.rows[row].form) {
                if (values) {
                    *values++ = factor;
                    continue;
                }
                *rows++ = static_cast<Index>(row);
                *columns++ = static_cast<Index>(variable);
            }
        return true;
    }

    bool eval_h(Index, const Number*, bool, Number times, Index, const Number*, bool, Index, Index* rows, Index* columns,
                Number* values) override {
        for (const auto& [row, column, factor] : programme_.hessian) {
            if (values) {
                *values++ = times * factor;
                continue;
            }
            *rows++ = static_cast<Index>(row);
            *columns++ = static_cast<Index>(column);
        }
        return true;
    }

    void finalize_solution(Ipopt::SolverReturn, Index variables, const Number* x, const Number*, const Number*, Index rows, const Number*,
                           const Number* lambda, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
        solution_.x.assign(x, x + variables);
        solution_.prices.assign(lambda, lambda + rows);
        for (double& price : solution_.prices)
            price = std::abs(price);
    }

  private:
    const QuadraticProgramme& programme_;
    QuadraticSolution& solution_;
};

} // namespace

extern "C" __attribute__((visibility("default"))) void fernlicht_solve_by_ipopt(const QuadraticProgramme& programme,
                                                                                QuadraticSolution& solution) {
    solution.by = "Ipopt " IPOPT_VERSION;
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = IpoptApplicationFactory();
    const Ipopt::SmartPtr<Ipopt::TNLP> asked = new Programme(programme, solution);
    const Ipopt::SmartPtr<Ipopt::OptionsList> options = solver->Options();
    options->SetIntegerValue("print_level", 0);
    options->SetStringValue("sb", "yes");            // no banner
    options->SetStringValue("option_file_name", ""); // nothing that lies in the folder
    for (const char* constant : {"hessian_constant", "jac_c_constant", "jac_d_constant"})
        options->SetStringValue(constant, "yes");
    options->SetStringValue("nlp_scaling_method", "none"); // all is near 1 but what a miss costs
    if (solver->Initialize() != Ipopt::Solve_Succeeded)
        return;
    const Ipopt::ApplicationReturnStatus status = solver->OptimizeTNLP(asked);
    solution.solved = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
}

} // namespace fernlicht
