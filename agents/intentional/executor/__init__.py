"""How an abstract action is carried out at the fine resolution (P 3.3)."""
