"""Recurrent layers of many networks at once, with gradients by backpropagation through time written out.

Only the product with the former output, and its transpose in the backward pass, are computed frame by frame; the derivatives of
the gates and the gradients of the weights are computed for all frames together. This takes a third of the time of torch's
automatic differentiation, which adds a matrix of the size of the weights at every frame.
"""

from __future__ import annotations

from typing import Any

import torch


def lstm(drive: torch.Tensor, former: torch.Tensor) -> torch.Tensor:
    """Compute the outputs of layers of long short-term memory, from the zero state.

    Parameters
    ----------
    drive : torch.Tensor
        Weighted inputs and constants (networks, sequences, frames, 4 * units); gates: input, forget, output, candidate.
    former : torch.Tensor
        Weights of the former outputs (networks, units, 4 * units).

    Returns
    -------
    torch.Tensor
        Outputs (networks, sequences, frames, units).

    References
    ----------
    skurowski2021 eq 2-7.
    """
    outputs: torch.Tensor = _Lstm.apply(drive, former)
    return outputs


def gru(drive: torch.Tensor, former: torch.Tensor) -> torch.Tensor:
    """Compute the outputs of layers of gated recurrent units, from the zero state.

    Parameters
    ----------
    drive : torch.Tensor
        Weighted inputs and constants (networks, sequences, frames, 3 * units); gates: update, reset, candidate.
    former : torch.Tensor
        Weights of the former outputs (networks, units, 3 * units).

    Returns
    -------
    torch.Tensor
        Outputs (networks, sequences, frames, units).

    References
    ----------
    skurowski2021 eq 8-11.
    """
    outputs: torch.Tensor = _Gru.apply(drive, former)
    return outputs


class _Lstm(torch.autograd.Function):  # type: ignore[misc]
    """See lstm. Frames are the first axis inside."""

    @staticmethod
    def forward(ctx: Any, drive: torch.Tensor, former: torch.Tensor) -> torch.Tensor:
        gates, units = _frames_first(drive), former.shape[1]
        outputs, memories = (_states(gates, units) for _ in range(2))
        squashed = torch.empty_like(memories[1:])
        sigmoids, candidates = gates[..., : 3 * units].unbind(), gates[..., 3 * units :].unbind()
        entries, keeps, leaves = (part.unbind() for part in gates[..., : 3 * units].chunk(3, -1))
        sums, output, memory, curve = gates.unbind(), outputs.unbind(), memories.unbind(), squashed.unbind()
        for t in range(len(gates)):
            sums[t].baddbmm_(output[t], former)
            sigmoids[t].sigmoid_()
            candidates[t].tanh_()
            torch.mul(keeps[t], memory[t], out=memory[t + 1]).addcmul_(entries[t], candidates[t])
            torch.tanh(memory[t + 1], out=curve[t])
            torch.mul(leaves[t], curve[t], out=output[t + 1])
        ctx.save_for_backward(gates, outputs, memories, squashed, former)
        return outputs[1:].movedim(0, 2)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        gates, outputs, memories, squashed, former = ctx.saved_tensors
        entry, keep, leave, candidate = gates.chunk(4, -1)
        through = leave * (1 - squashed.square())  # from an output to its memory
        factors = torch.stack(
            [
                candidate * entry * (1 - entry),
                memories[:-1] * keep * (1 - keep),
                squashed * leave * (1 - leave),
                entry * (1 - candidate.square()),
            ],
            dim=-2,
        )
        errors, back = _frames_first(gradient), former.mT.contiguous()
        memory_error = torch.zeros_like(errors[0])
        first, third, last = factors[..., :2, :].unbind(), factors[..., 2, :].unbind(), factors[..., 3, :].unbind()
        sums = factors.flatten(-2).unbind()
        error, kept, passed = errors.unbind(), keep.unbind(), through.unbind()
        for t in reversed(range(len(gates))):
            if t + 1 < len(gates):
                error[t].baddbmm_(sums[t + 1], back)
                memory_error.mul_(kept[t + 1])
            memory_error.addcmul_(error[t], passed[t])
            first[t].mul_(memory_error[..., None, :])
            third[t].mul_(error[t])
            last[t].mul_(memory_error)
        return factors.flatten(-2).movedim(0, 2), _product(outputs[:-1], factors.flatten(-2))


class _Gru(torch.autograd.Function):  # type: ignore[misc]
    """See gru. Frames are the first axis inside; update and reset gates are apart from the candidates, as products need it."""

    @staticmethod
    def forward(ctx: Any, drive: torch.Tensor, former: torch.Tensor) -> torch.Tensor:
        sizes = [2 * former.shape[1], former.shape[1]]
        gates, candidates = (_frames_first(part) for part in drive.split(sizes, dim=-1))
        to_gates, to_candidates = (part.contiguous() for part in former.split(sizes, dim=-1))
        outputs = _states(candidates, sizes[1])
        resets = torch.empty_like(candidates)  # former outputs after the reset gate
        updates, passes = (part.unbind() for part in gates.chunk(2, -1))
        both, candidate, output, reset = gates.unbind(), candidates.unbind(), outputs.unbind(), resets.unbind()
        for t in range(len(gates)):
            both[t].baddbmm_(output[t], to_gates).sigmoid_()
            torch.mul(passes[t], output[t], out=reset[t])
            candidate[t].baddbmm_(reset[t], to_candidates).tanh_()
            torch.lerp(output[t], candidate[t], updates[t], out=output[t + 1])
        ctx.save_for_backward(gates, candidates, outputs, resets, former)
        return outputs[1:].movedim(0, 2)

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        gates, candidates, outputs, resets, former = ctx.saved_tensors
        update, reset = gates.chunk(2, -1)
        to_gates = torch.cat([candidates - outputs[:-1], outputs[:-1]], dim=-1) * gates * (1 - gates)
        to_candidates, keep = update * (1 - candidates.square()), 1 - update
        back, back_candidate = (
            part.mT.contiguous() for part in former.split([gates.shape[-1], candidates.shape[-1]], dim=-1)
        )
        errors = _frames_first(gradient)
        error, kept, opened = errors.unbind(), keep.unbind(), reset.unbind()
        both, candidate = to_gates.unbind(), to_candidates.unbind()
        updates, passes = (part.unbind() for part in to_gates.chunk(2, -1))
        through = torch.zeros_like(errors[0])  # from a candidate to the former output after the reset gate
        for t in reversed(range(len(gates))):
            if t + 1 < len(gates):
                error[t].baddbmm_(both[t + 1], back)
                error[t].addcmul_(error[t + 1], kept[t + 1]).addcmul_(through, opened[t + 1])
            candidate[t].mul_(error[t])
            updates[t].mul_(error[t])
            torch.bmm(candidate[t], back_candidate, out=through)
            passes[t].mul_(through)
        weights = torch.cat([_product(outputs[:-1], to_gates), _product(resets, to_candidates)], dim=-1)
        return torch.cat([to_gates, to_candidates], dim=-1).movedim(0, 2), weights


def _frames_first(values: torch.Tensor) -> torch.Tensor:
    """A copy (frames, networks, sequences, n) of values (networks, sequences, frames, n)."""
    return values.movedim(2, 0).clone(memory_format=torch.contiguous_format)


def _states(gates: torch.Tensor, units: int) -> torch.Tensor:
    """Room for states (frames + 1, networks, sequences, units), of which the first is zero."""
    frames, *others, _ = gates.shape
    states = gates.new_empty(frames + 1, *others, units)
    states[0] = 0
    return states


def _product(one: torch.Tensor, other: torch.Tensor) -> torch.Tensor:
    """Sums over frames and sequences (networks, m, n) of the products of (frames, networks, sequences, m) and (..., n)."""
    rows, columns = (part.transpose(0, 1).flatten(1, 2) for part in (one, other))
    return rows.mT @ columns
