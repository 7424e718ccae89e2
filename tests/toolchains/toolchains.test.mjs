// The packed package in every toolchain that it promises to work with, run as its users run it. One file, since the tools
// are installed once.
import './angular.mjs';
import './engines.mjs';
import './bundlers.mjs';
import './next.mjs';
import './runners.mjs';
import './types.mjs';
