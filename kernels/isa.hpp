#pragma once

// Every kernel source is compiled once per instruction set, with LANESCAPE_ISA set to its name. The name is also the namespace, so
// the objects of different instruction sets can be linked into one program.

#ifndef LANESCAPE_ISA
#define LANESCAPE_ISA generic
#endif

#define LANESCAPE_ISA_STRING_(x) #x
#define LANESCAPE_ISA_STRING(x) LANESCAPE_ISA_STRING_(x)
