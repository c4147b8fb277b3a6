/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A real folder joined to the shelf's port: its pieces are the folders in it.
 * Is not:  The folders themselves (platform/storage); what is done with them (station/shelf.h).
 * Owner:   shelf_store_close, when nobody uses the port any more.
 * Errors:  a sentence with the path. The port's own calls answer such sentences as well.
 */
#ifndef GLAISE_WIRING_SHELF_STORE_H
#define GLAISE_WIRING_SHELF_STORE_H

#include "station/shelf_port.h"

struct shelf_store;

/* Makes the folder when absent; one program at a time may have it. */
shelf_store *shelf_store_open(const std::string &folder, shelf_port *port_out, std::string *text_out);
void shelf_store_close(shelf_store *s); /* NULL is fine */

#endif
